"""What the make_*.py scripts share: a folder of generated files, written or compared."""

from pathlib import Path

Contents = dict[str, bytes]  # by file name

# Kept beside generated files, written by hand.
NOT_GENERATED = {"README.md"}


def write(folder: Path, contents: Contents) -> int:
    """Make the folder hold exactly these files. The exit status, 0."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in strangers(folder, contents):
        (folder / name).unlink()
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    print(f"{len(contents)} files written to {folder}")
    return 0


def compare(folder: Path, contents: Contents) -> int:
    """List what differs from what would be written. The exit status, 1 if anything does."""
    differences = [f"unexpected: {name}" for name in strangers(folder, contents)]
    for name, content in contents.items():
        path = folder / name
        if not path.exists():
            differences.append(f"missing: {name}")
        elif path.read_bytes() != content:
            differences.append(f"different: {name}")
    print("\n".join(differences) or f"{len(contents)} files in {folder} are as generated")
    return 1 if differences else 0


def strangers(folder: Path, contents: Contents) -> list[str]:
    """Files of the folder that are not generated."""
    present = {path.name for path in folder.glob("*") if path.is_file()}
    return sorted(present - contents.keys() - NOT_GENERATED)

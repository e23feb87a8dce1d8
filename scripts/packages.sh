# Sourced by the other scripts: sees to the Debian packages they need.

# require_packages PACKAGE… : installs what is missing, or says in one sentence how to get it.
require_packages() {
    command -v dpkg-query >/dev/null || return 0
    local package missing=()
    for package in "$@"; do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        sudo -n true 2>/dev/null || {
            echo "These Debian packages are missing: run “sudo apt-get install --no-install-recommends ${missing[*]}” and start again." >&2
            return 1
        }
        as_root=(sudo -n)
    fi
    echo "Installing ${missing[*]} …" >&2
    "${as_root[@]}" apt-get update -qq
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -qq -y --no-install-recommends "${missing[@]}" >/dev/null
}

# The libraries the window opens at run time (X11, the keyboard, software or hardware GL).
WINDOW_PACKAGES="libx11-6 libx11-xcb1 libxcursor1 libxi6 libxrandr2 libxkbcommon-x11-0 libegl1 libgl1 libgl1-mesa-dri"

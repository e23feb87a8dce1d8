//! The smallest window that the program allows.

use eframe::egui::{Key, Modifiers, Rect, accesskit::Role};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::drive::Window;

const SMALLEST: [f32; 2] = [1000.0, 640.0];
/// Where the bar at the bottom begins.
const STATUS: f32 = SMALLEST[1] - 30.0;

/// The page of plans with two materials, so that no row is cut by the end of the list.
fn planner() -> Window {
    let mut window = Window::open(None);
    window.press(Modifiers::COMMAND, Key::Num4);
    for name in ["Zinc", "Copper"] {
        window.click(&format!("Remove {name}"));
    }
    window.harness.set_size(SMALLEST.into());
    window.settle();
    window
}

/// Every text in the window with its place.
fn texts(window: &Window) -> Vec<(String, Rect)> {
    let labels = window.harness.query_all_by_role(Role::Label);
    let text = |node: &egui_kittest::Node<'_>| node.accesskit_node().value().unwrap_or_default();
    labels.map(|node| (text(&node), node.rect())).filter(|(text, _)| !text.is_empty()).collect()
}

#[test]
fn nothing_is_written_over_anything_else() {
    let window = planner();
    let texts = texts(&window);
    let inside: Vec<&(String, Rect)> = texts.iter().filter(|(_, rect)| rect.bottom() < STATUS).collect();
    assert!(inside.len() > 30, "{inside:?}");
    for (index, (text, rect)) in inside.iter().enumerate() {
        assert!(rect.right() <= SMALLEST[0], "{text} leaves the window: {rect:?}");
        for (other, place) in &inside[index + 1..] {
            assert!(!rect.shrink(1.0).intersects(place.shrink(1.0)), "“{text}” {rect:?} over “{other}” {place:?}");
        }
    }
}

#[test]
fn rows_show_where_each_material_is_seen_and_what_is_chosen() {
    let window = planner();
    for name in ["Gold", "Chromium"] {
        let remove = window.harness.get_by_label(&format!("Remove {name}")).rect();
        let row = window.harness.get_by_label_contains(&format!("Look at {name}: ")).rect();
        let last = if name == "Gold" { "Largest tilt of Gold" } else { "Farthest place of Chromium" };
        for label in [format!("Where {name} is seen"), last.to_owned()] {
            let rect = window.harness.get_by_label(&label).rect();
            assert!(row.contains_rect(rect) && rect.right() < remove.left(), "{label}: {rect:?} in {row:?}");
        }
    }
}

#[test]
fn every_variant_of_the_table_has_its_name_and_its_verdict() {
    let mut window = planner();
    window.enter("Tolerance, number", "1");
    let texts = texts(&window);
    let place = |wanted: &str| texts.iter().find(|(text, _)| text == wanted).unwrap_or_else(|| panic!("{wanted}")).1;
    assert!(place("Cheapest first").right() < place("operations").left());
    assert!(place("verdict").right() <= SMALLEST[0] - 12.0 - 4.0, "{:?}", place("verdict"));
    for verdict in ["too far", "chosen"] {
        let row = place(verdict);
        assert!(row.right() <= place("verdict").right() + 1.0);
        let named = |rect: &Rect| rect.left() >= place("Cheapest first").left() - 8.0 && rect.width() > 40.0;
        let in_row = |rect: &Rect| (rect.center().y - row.center().y).abs() < 6.0 && rect.right() < row.left();
        assert!(texts.iter().any(|(_, rect)| in_row(rect) && named(rect)), "no name beside “{verdict}”");
    }
}

/// However low and narrow the window is, it is seen how good the spheres are.
#[test]
fn the_quality_of_the_spheres_is_in_the_window() {
    for size in [SMALLEST, [1280.0, SMALLEST[1]], [1000.0, 680.0]] {
        let window = Window::of_size(size, None);
        let inspector = window.harness.get_by_label("Name").rect();
        let words = window.harness.get_by_label("Finished: every pixel, every nanometre").rect();
        assert!(words.bottom() < size[1] - 40.0 && words.right() < inspector.left(), "{size:?}: {words:?}");
        let map = window.harness.get_by_label("map of the colour difference").rect();
        assert!(
            map.right() < inspector.left() && map.bottom() < words.top() && map.width() > 40.0,
            "{size:?}: {map:?}"
        );
    }
}

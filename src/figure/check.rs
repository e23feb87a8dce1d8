//! What every figure's test asks of it.

use super::drawing::Drawing;

/// Every text is inside the page, and no two overlap.
pub(super) fn assert_texts_are_legible(drawing: &Drawing) {
    let boxes: Vec<(&str, [f64; 4])> = drawing.labels().map(|label| (label.text.as_str(), label.bounds())).collect();
    for (index, (text, [left, top, right, bottom])) in boxes.iter().enumerate() {
        let is_inside = *left >= 4.0 && *top >= 4.0 && *right <= drawing.width - 4.0 && *bottom <= drawing.height - 4.0;
        assert!(is_inside, "“{text}” leaves the page of “{}”", drawing.title);
        for (other, [l, t, r, b]) in &boxes[index + 1..] {
            let overlap = left < r && l < right && top < b && t < bottom;
            assert!(!overlap, "“{text}” and “{other}” overlap in “{}”", drawing.title);
        }
    }
}

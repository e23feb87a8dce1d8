//! Every colour and size of the window.
//!
//! The greys are exactly neutral: a tinted surround shifts how a metal beside it is judged.
//! The one accent marks what is selected; the channels keep their own three colours everywhere.

use std::sync::Arc;

use eframe::egui::{
    Color32, Context, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Margin, RichText, Shadow, Stroke,
    Style, TextStyle, Theme, Ui, Vec2, Visuals, style::HandleShape, vec2,
};
use egui_plot::LineStyle;

/// Size of the window when it first opens.
pub(crate) const WINDOW_SIZE: [f32; 2] = [1280.0, 800.0];
/// Below this the panels would overlap.
pub(crate) const SMALLEST_WINDOW: [f32; 2] = [1000.0, 640.0];

/// Space between things that belong together.
pub(crate) const GAP: f32 = 6.0;
/// Space between groups.
pub(crate) const GROUP_GAP: f32 = 14.0;
/// Margin of the panels.
pub(crate) const MARGIN: i8 = 12;
/// Height of one row of fields.
pub(crate) const ROW: f32 = 22.0;
/// Rounding of fields, swatches and pictures.
pub(crate) const ROUNDING: u8 = 3;

/// Width of the panel of the photograph.
pub(crate) const PHOTO_WIDTH: f32 = 368.0;
/// Width of the inspector of the preset.
pub(crate) const INSPECTOR_WIDTH: f32 = 340.0;
/// Width of the library of metals.
pub(crate) const LIBRARY_WIDTH: f32 = 250.0;
/// Width of the words in front of a row of fields.
pub(crate) const LABEL_WIDTH: f32 = 84.0;
/// Between the columns of a match: three numbers with their ± just fit.
pub(crate) const MATCH_GAP: f32 = 10.0;
/// Width of the tab of a page.
pub(crate) const TAB_WIDTH: f32 = 92.0;
/// Width of the name of a mark.
pub(crate) const MARK_WIDTH: f32 = 104.0;
/// Height of a preset in a list, with its sphere.
pub(crate) const THUMBNAIL: f32 = 52.0;
/// Width of the menu of the preview's quality.
pub(crate) const PREVIEW_MENU: f32 = 300.0;
/// Side of a sphere preview.
pub(crate) const SPHERE: f32 = 176.0;
/// Height of the two lines that say how good the spheres are.
pub(crate) const STANDING: f32 = 30.0;
/// Side of the swatch of a colour editor.
pub(crate) const SWATCH: f32 = 64.0;
/// Height of each strip of swatches.
pub(crate) const STRIP: f32 = 30.0;
/// Room for the numbers of the vertical axis.
pub(crate) const AXIS_WIDTH: f32 = 34.0;
/// Width of a modal dialog.
pub(crate) const DIALOG_WIDTH: f32 = 440.0;
/// Size of the dialog of an export; it fits into the smallest window.
pub(crate) const EXPORT_SIZE: [f32; 2] = [920.0, 560.0];
/// Width of its list of targets.
pub(crate) const TARGET_LIST: f32 = 236.0;
/// Size of its plot.
pub(crate) const EXPORT_PLOT: Vec2 = Vec2::new(370.0, 190.0);
/// Width of the searchable menu.
pub(crate) const FINDER_WIDTH: f32 = 320.0;
/// Height of the searchable menu's list.
pub(crate) const FINDER_HEIGHT: f32 = 360.0;

/// Width of the curve of the preset.
pub(crate) const CURVE: f32 = 2.0;
/// Width of the curves it is compared with.
pub(crate) const THIN_CURVE: f32 = 1.2;
/// Width of a measured truth beneath models.
pub(crate) const TRUTH_CURVE: f32 = 4.0;
/// Radius of a handle on a curve.
pub(crate) const HANDLE_RADIUS: f32 = 5.0;

/// False colours of pixels that must not be measured: the same in both themes, since they stand on a photograph.
pub(crate) const CLIPPED: Color32 = Color32::from_rgb(0xff, 0x2d, 0x2d);
/// Too dark to measure.
pub(crate) const BLACK: Color32 = Color32::from_rgb(0x2f, 0x5d, 0xff);
/// Not a number.
pub(crate) const NON_FINITE: Color32 = Color32::from_rgb(0xff, 0x3d, 0xf2);
/// Below zero: outside Rec.709.
pub(crate) const NEGATIVE: Color32 = Color32::from_rgb(0x2f, 0xe0, 0xe0);

/// Marks on a photograph, with a dark edge so that they stand out on anything.
pub(crate) const MARK: Color32 = Color32::from_rgb(0xff, 0xd8, 0x4d);
/// The mark that is selected.
pub(crate) const SELECTED_MARK: Color32 = Color32::from_gray(0xff);
/// The edge of marks.
pub(crate) const MARK_EDGE: Color32 = Color32::from_black_alpha(0xa0);
/// A line at the limit of a band of angles, and its dark side.
pub(crate) const BAND: Color32 = Color32::from_rgba_premultiplied(0x90, 0x90, 0x90, 0x90);
/// The dark side of that line.
pub(crate) const BAND_EDGE: Color32 = Color32::from_black_alpha(0x60);
/// Half the side of a mark's grip.
pub(crate) const GRIP: f32 = 4.0;
/// How near the pointer must come to a grip.
pub(crate) const GRIP_REACH: f32 = 9.0;
/// Between the pixels of the loupe.
pub(crate) const LOUPE_GRID: Color32 = Color32::from_gray(0x1c);
/// Side of the loupe.
pub(crate) const LOUPE: f32 = 112.0;
/// The grip of the handle between the photograph and the rendered match.
pub(crate) const WIPE_GRIP: Vec2 = Vec2::new(7.0, 28.0);
/// Height of the row that explains false colours.
pub(crate) const SCALE_ROW: f32 = 20.0;
/// The bar of false colours in it.
pub(crate) const SCALE_BAR: Vec2 = Vec2::new(64.0, 8.0);
/// Height of the tile of a mode, with its letter above its drawing.
pub(crate) const MODE_TILE: f32 = 50.0;
/// Height of the letter.
pub(crate) const MODE_LETTER: f32 = 13.0;
/// Height of the photograph in its panel.
pub(crate) const PHOTO_HEIGHT: f32 = 236.0;
/// Least and greatest width of the panel of the photograph.
pub(crate) const PHOTO_WIDTHS: std::ops::RangeInclusive<f32> = 320.0..=640.0;

/// Room left and right of the name of a page.
pub(crate) const TAB_PADDING: f32 = 10.0;
/// Width of the list of demonstrations and what they are about.
pub(crate) const DEMONSTRATIONS_WIDTH: f32 = 276.0;
/// Room for names left of the bands of a demonstration.
pub(crate) const BAND_NAMES: f32 = 64.0;
/// Room for numbers right of them.
pub(crate) const BAND_NUMBERS: f32 = 136.0;
/// Height of a band of colours.
pub(crate) const BAND_HEIGHT: f32 = 22.0;
/// Least height of a chart of a demonstration.
pub(crate) const LEAST_CHART: f32 = 96.0;
/// Height of the names under an axis.
pub(crate) const TICKS: f32 = 20.0;
/// Largest side of a painted sphere.
pub(crate) const PAINTED_SPHERE: f32 = 138.0;
/// Radius of a dot that stands for a measured metal.
pub(crate) const DOT: f32 = 3.0;
/// How near the pointer must come to a dot to name it.
pub(crate) const DOT_REACH: f32 = 7.0;
/// Half the width of a cross that stands for a channel of the preset.
pub(crate) const CROSS: f32 = 9.0;
/// Width of the fields beside the square of r and h.
pub(crate) const READ_OUT_WIDTH: f32 = 316.0;

/// Height of a material of a plan.
pub(crate) const PLAN_ROW: f32 = 50.0;
/// Its height where what is chosen stands below where it is seen.
pub(crate) const PLAN_ROW_STACKED: f32 = 92.0;
/// Below this width it does.
pub(crate) const PLAN_STACKS_BELOW: f32 = 960.0;
/// Width of its strip of colours.
pub(crate) const PLAN_STRIP: f32 = 132.0;
/// Room for the model that was chosen, its error, and its cost.
pub(crate) const PLAN_COLUMNS: [f32; 3] = [236.0, 104.0, 112.0];
/// Room for the table of everything that was looked at.
pub(crate) const JUDGEMENTS: f32 = 440.0;
/// Room for an error, operations, bytes and a verdict in it.
pub(crate) const JUDGEMENT_COLUMNS: [f32; 4] = [62.0, 62.0, 56.0, 58.0];
/// The most of the width that it takes.
pub(crate) const JUDGEMENTS_SHARE: f32 = 0.58;
/// Height of its rows.
pub(crate) const JUDGEMENT_ROW: f32 = 17.0;
/// Least height of what is said of one material.
pub(crate) const PLAN_DETAIL: f32 = 268.0;
/// Least height of its chart and its table.
pub(crate) const PLAN_CHART: f32 = 216.0;

/// The colours that egui's own visuals have no place for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Palette {
    /// Behind photographs, plots and spheres.
    pub canvas: Color32,
    /// Red, green and blue channels.
    pub channels: [Color32; 3],
    /// The accent, for what is selected and for handles.
    pub accent: Color32,
    /// Models that are compared with each other.
    pub models: [Color32; 8],
    /// Where the three channels are one.
    pub grey: Color32,
    /// Lines of a plot's grid.
    pub grid: Color32,
    /// Lines that mark an angle.
    pub guide: Color32,
    /// A warning's sign.
    pub warning: Color32,
    /// Something that failed.
    pub error: Color32,
    /// Something that is as it should be.
    pub good: Color32,
    /// A scale of errors: none, some, much.
    pub heat: [Color32; 3],
}

const DARK: Palette = Palette {
    canvas: Color32::from_gray(0x1c),
    channels: [
        Color32::from_rgb(0xe8, 0x6a, 0x62),
        Color32::from_rgb(0x74, 0xc2, 0x7b),
        Color32::from_rgb(0x74, 0x9f, 0xee),
    ],
    accent: Color32::from_rgb(0x86, 0xac, 0xdc),
    models: [
        Color32::from_gray(0xf0),
        Color32::from_rgb(0xe0, 0xa4, 0x58),
        Color32::from_rgb(0xb9, 0xa0, 0xe8),
        Color32::from_rgb(0x5f, 0xc4, 0xc0),
        Color32::from_rgb(0x4f, 0x93, 0x90),
        Color32::from_rgb(0xe2, 0x7f, 0xa4),
        Color32::from_rgb(0xa9, 0xc4, 0x6c),
        Color32::from_rgb(0x7d, 0x8f, 0xe6),
    ],
    grey: Color32::from_gray(0xd0),
    grid: Color32::from_gray(0x34),
    guide: Color32::from_gray(0x86),
    warning: Color32::from_rgb(0xe3, 0xb5, 0x5c),
    error: Color32::from_rgb(0xec, 0x8c, 0x7e),
    good: Color32::from_rgb(0x8f, 0xbf, 0x95),
    heat: [Color32::from_gray(0x1c), Color32::from_rgb(0x8a, 0x5a, 0x14), Color32::from_rgb(0xf0, 0x5d, 0x48)],
};

const LIGHT: Palette = Palette {
    canvas: Color32::from_gray(0xf1),
    channels: [
        Color32::from_rgb(0xbe, 0x33, 0x2b),
        Color32::from_rgb(0x27, 0x7a, 0x38),
        Color32::from_rgb(0x2a, 0x5d, 0xbd),
    ],
    accent: Color32::from_rgb(0x2b, 0x5f, 0x9e),
    models: [
        Color32::from_gray(0x10),
        Color32::from_rgb(0xa0, 0x5f, 0x0a),
        Color32::from_rgb(0x66, 0x45, 0xa8),
        Color32::from_rgb(0x0c, 0x74, 0x70),
        Color32::from_rgb(0x4a, 0x84, 0x82),
        Color32::from_rgb(0xa8, 0x2c, 0x5e),
        Color32::from_rgb(0x55, 0x70, 0x14),
        Color32::from_rgb(0x34, 0x44, 0xa8),
    ],
    grey: Color32::from_gray(0x30),
    grid: Color32::from_gray(0xdc),
    guide: Color32::from_gray(0x74),
    warning: Color32::from_rgb(0x87, 0x57, 0x00),
    error: Color32::from_rgb(0xa3, 0x2e, 0x1c),
    good: Color32::from_rgb(0x2c, 0x6b, 0x38),
    heat: [Color32::from_gray(0xf1), Color32::from_rgb(0xf7, 0xc9, 0x6b), Color32::from_rgb(0xb8, 0x2a, 0x22)],
};

/// Neutral greys of one theme, from the ground up.
struct Greys {
    panel: u8,
    field: u8,
    button: u8,
    hovered: u8,
    pressed: u8,
    line: u8,
    weak_text: u8,
    text: u8,
    strong_text: u8,
    selection: Color32,
    selected_text: Color32,
}

const DARK_GREYS: Greys = Greys {
    panel: 0x29,
    field: 0x1e,
    button: 0x3a,
    hovered: 0x46,
    pressed: 0x52,
    line: 0x3d,
    weak_text: 0xa0,
    text: 0xd4,
    strong_text: 0xf4,
    selection: Color32::from_rgb(0x3c, 0x56, 0x78),
    selected_text: Color32::from_gray(0xff),
};

const LIGHT_GREYS: Greys = Greys {
    panel: 0xdf,
    field: 0xf3,
    button: 0xce,
    hovered: 0xc2,
    pressed: 0xb5,
    line: 0xbe,
    weak_text: 0x56,
    text: 0x24,
    strong_text: 0x00,
    selection: Color32::from_rgb(0xa9, 0xc2, 0xe4),
    selected_text: Color32::from_gray(0x00),
};

impl Palette {
    /// The palette of the theme that is being drawn.
    pub(crate) fn of(ui: &Ui) -> Self {
        if ui.visuals().dark_mode { DARK } else { LIGHT }
    }

    /// The colour of a share 0–1 of a scale of errors.
    pub(crate) fn heat(&self, share: f64) -> Color32 {
        let position = share.clamp(0.0, 1.0) as f32 * 2.0;
        let index = usize::from(position >= 1.0);
        self.heat[index].lerp_to_gamma(self.heat[index + 1], position - index as f32)
    }
}

/// Installs the fonts and both themes.
pub(crate) fn install(ctx: &Context) {
    ctx.set_fonts(fonts());
    ctx.set_style_of(Theme::Dark, style(Visuals::dark(), &DARK_GREYS, DARK));
    ctx.set_style_of(Theme::Light, style(Visuals::light(), &LIGHT_GREYS, LIGHT));
}

fn semi_bold() -> FontFamily {
    FontFamily::Name("semi-bold".into())
}

/// Inter for words, Hack for numbers; Hack also lends both the arrows and shapes that Inter lacks.
fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    let mut add = |name: &str, bytes: &'static [u8]| {
        fonts.font_data.insert(name.to_owned(), Arc::new(FontData::from_static(bytes)));
    };
    add("Inter", include_bytes!("../../assets/fonts/Inter-Regular.ttf"));
    add("Inter SemiBold", include_bytes!("../../assets/fonts/Inter-SemiBold.ttf"));
    let fallbacks = fonts.families.get(&FontFamily::Proportional).cloned().unwrap_or_default();
    let with_fallbacks = |first: &str| {
        let mut names = vec![first.to_owned()];
        names.extend(fallbacks.iter().cloned());
        names.push("Hack".to_owned());
        names
    };
    fonts.families.insert(FontFamily::Proportional, with_fallbacks("Inter"));
    fonts.families.insert(semi_bold(), with_fallbacks("Inter SemiBold"));
    fonts
}

fn style(visuals: Visuals, greys: &Greys, palette: Palette) -> Style {
    let mut style = Style { visuals, animation_time: 0.08, ..Style::default() };
    style.text_styles = [
        (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
        (TextStyle::Body, FontId::new(12.5, FontFamily::Proportional)),
        (TextStyle::Button, FontId::new(12.5, FontFamily::Proportional)),
        (TextStyle::Heading, FontId::new(15.0, semi_bold())),
        (TextStyle::Monospace, FontId::new(11.5, FontFamily::Monospace)),
    ]
    .into();
    style.drag_value_text_style = TextStyle::Monospace;
    space(&mut style);
    paint(&mut style.visuals, greys, palette);
    style
}

fn space(style: &mut Style) {
    let spacing = &mut style.spacing;
    spacing.item_spacing = vec2(GAP, GAP);
    spacing.button_padding = vec2(8.0, 3.0);
    spacing.interact_size = vec2(36.0, ROW);
    spacing.menu_margin = Margin::same(6);
    spacing.window_margin = Margin::same(16);
    spacing.combo_width = 60.0;
    spacing.slider_rail_height = 4.0;
    spacing.scroll.bar_width = 8.0;
    spacing.tooltip_width = 320.0;
    style.interaction.tooltip_delay = 0.4;
    style.interaction.selectable_labels = false;
}

fn paint(visuals: &mut Visuals, greys: &Greys, palette: Palette) {
    let grey = Color32::from_gray;
    visuals.panel_fill = grey(greys.panel);
    visuals.window_fill = grey(greys.panel);
    visuals.window_stroke = Stroke::new(1.0, grey(greys.line));
    visuals.extreme_bg_color = grey(greys.field);
    visuals.faint_bg_color = grey(greys.panel.saturating_add(if visuals.dark_mode { 5 } else { 8 }));
    visuals.weak_text_color = Some(grey(greys.weak_text));
    visuals.hyperlink_color = palette.accent;
    visuals.warn_fg_color = palette.warning;
    visuals.error_fg_color = palette.error;
    visuals.selection.bg_fill = greys.selection;
    visuals.selection.stroke = Stroke::new(1.0, greys.selected_text);
    visuals.text_cursor.stroke = Stroke::new(1.5, palette.accent);
    visuals.window_corner_radius = CornerRadius::same(6);
    visuals.menu_corner_radius = CornerRadius::same(5);
    let shadow = Shadow { offset: [0, 4], blur: 16, spread: 0, color: Color32::from_black_alpha(70) };
    (visuals.window_shadow, visuals.popup_shadow) = (shadow, shadow);
    visuals.handle_shape = HandleShape::Rect { aspect_ratio: 0.5 };
    visuals.striped = false;
    let widgets = &mut visuals.widgets;
    let states = [
        (&mut widgets.noninteractive, greys.panel, greys.text, grey(greys.line)),
        (&mut widgets.inactive, greys.button, greys.text, Color32::TRANSPARENT),
        (&mut widgets.hovered, greys.hovered, greys.strong_text, Color32::TRANSPARENT),
        (&mut widgets.active, greys.pressed, greys.strong_text, palette.accent),
        (&mut widgets.open, greys.hovered, greys.strong_text, Color32::TRANSPARENT),
    ];
    for (widget, fill, text, outline) in states {
        (widget.bg_fill, widget.weak_bg_fill) = (grey(fill), grey(fill));
        widget.fg_stroke = Stroke::new(1.0, grey(text));
        widget.bg_stroke = Stroke::new(1.0, outline);
        widget.corner_radius = CornerRadius::same(ROUNDING);
        widget.expansion = 0.0;
    }
}

/// A handle that stands out on any colour of a slider's rail: white with a black edge.
pub(crate) fn set_slider_handle(visuals: &mut Visuals) {
    let widgets = &mut visuals.widgets;
    for widget in [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active] {
        widget.bg_fill = Color32::from_gray(0xf4);
        widget.fg_stroke = Stroke::new(1.0, Color32::from_gray(0x10));
    }
}

/// The look of a model's line among the models it is compared with, by its place in the list.
pub(crate) fn contestant_line(index: usize) -> (LineStyle, f32) {
    let style = match index {
        0 => LineStyle::Solid,
        1 => LineStyle::Dotted { spacing: 4.0 },
        2 => LineStyle::Dashed { length: 9.0 },
        3 => LineStyle::Dashed { length: 5.0 },
        4 => LineStyle::Dotted { spacing: 7.0 },
        5 => LineStyle::Dashed { length: 3.0 },
        6 => LineStyle::Dashed { length: 14.0 },
        _ => LineStyle::Dotted { spacing: 10.0 },
    };
    (style, if index == 0 { CURVE - 0.4 } else { THIN_CURVE })
}

/// The look of another model of the preset, by its place in the legend.
pub(crate) fn comparison_line(index: usize) -> LineStyle {
    match index {
        0 => LineStyle::Dotted { spacing: 4.0 },
        1 => LineStyle::Dashed { length: 11.0 },
        2 => LineStyle::Dashed { length: 3.0 },
        _ => LineStyle::Dotted { spacing: 8.0 },
    }
}

/// Words above a group of controls.
pub(crate) fn title(text: impl Into<String>) -> RichText {
    RichText::new(text).font(FontId::new(12.5, semi_bold())).strong()
}

/// Words that explain, quieter than the rest.
pub(crate) fn hint(text: impl Into<String>) -> RichText {
    RichText::new(text).small().weak()
}

/// The sentence that says what is seen.
pub(crate) fn sentence(text: impl Into<String>) -> RichText {
    RichText::new(text).size(14.0)
}

/// Numbers that must stand in columns.
pub(crate) fn number(text: impl Into<String>) -> RichText {
    RichText::new(text).monospace()
}

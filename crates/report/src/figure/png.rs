//! A figure as PNG: the SVG drawn at two pixels per unit, with fonts of its own, so that the picture is the same on every machine.

use super::{Figure, Title, svg};
use words::Language;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The SVG could not be read back.
    #[error("the figure cannot be drawn: {0}")]
    Svg(String),
    /// The picture has no size or does not fit into memory.
    #[error("the picture of {0} x {1} pixels cannot be made")]
    Size(u32, u32),
    /// This library was built without the feature `png`.
    #[error("no pictures made of pixels: built without the feature `png`")]
    Absent,
    /// The picture could not be packed.
    #[error("the picture cannot be packed: {0}")]
    Pack(String),
}

/// The figure as the bytes of a PNG file.
///
/// *Errors*: none for any figure that [`svg::write`] makes; they stand for faults of the renderer.
pub fn write(figure: &Figure, title: Title, language: Language) -> Result<Vec<u8>, Error> {
    of_svg(&svg::write(figure, title, language))
}

/// Any SVG of ours as the bytes of a PNG file.
///
/// *Errors*: this library was built without the feature `png`; faults of the renderer.
pub fn of_svg(svg: &str) -> Result<Vec<u8>, Error> {
    pixels::of_svg(svg)
}

#[cfg(not(feature = "png"))]
mod pixels {
    use super::Error;

    /// A picture made of pixels.
    ///
    /// *Errors*: always, since this program draws none.
    pub fn of_svg(_: &str) -> Result<Vec<u8>, Error> {
        Err(Error::Absent)
    }
}

#[cfg(feature = "png")]
mod pixels {
    use super::Error;
    use resvg::{tiny_skia, usvg};
    use std::sync::{Arc, LazyLock};

    /// Pixels per unit of the SVG.
    const PIXELS: f32 = 2.0;

    /// DejaVu Sans, upright and slanted, with Latin, Greek, Cyrillic and mathematical signs.
    static FONTS: LazyLock<Arc<usvg::fontdb::Database>> = LazyLock::new(|| {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_font_data(include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf").to_vec());
        fonts.load_font_data(include_bytes!("../../assets/fonts/DejaVuSans-Oblique-subset.ttf").to_vec());
        fonts.set_sans_serif_family("DejaVu Sans");
        Arc::new(fonts)
    });

    /// The renderer takes clusters of one glyph only where a text changes its face: a mark above a letter would cost the letters behind it, or the program. Dots
    /// become the primes of the model file, Cyrillic letters their own, and other marks go.
    fn without_marks(svg: &str) -> String {
        let mut out = String::with_capacity(svg.len());
        for c in svg.chars() {
            let composed = match (out.chars().next_back(), c) {
                (Some('и'), '\u{306}') => Some('й'),
                (Some('И'), '\u{306}') => Some('Й'),
                (Some('е'), '\u{308}') => Some('ё'),
                (Some('Е'), '\u{308}') => Some('Ё'),
                _ => None,
            };
            match (composed, c) {
                (Some(letter), _) => {
                    out.pop();
                    out.push(letter);
                }
                (None, '\u{307}') => out.push('′'),
                (None, '\u{308}') => out.push('″'),
                (None, '\u{300}'..='\u{36f}') => {}
                (None, c) => out.push(c),
            }
        }
        out
    }

    /// A picture made of pixels.
    ///
    /// *Errors*: what is no drawing, or one without an area.
    pub fn of_svg(svg: &str) -> Result<Vec<u8>, Error> {
        let svg = &without_marks(svg);
        let options = usvg::Options { fontdb: FONTS.clone(), font_family: "DejaVu Sans".into(), ..usvg::Options::default() };
        let tree = usvg::Tree::from_str(svg, &options).map_err(|e| Error::Svg(e.to_string()))?;
        let size = tree.size();
        let (width, height) = ((size.width() * PIXELS).ceil() as u32, (size.height() * PIXELS).ceil() as u32);
        let mut pixels = tiny_skia::Pixmap::new(width, height).ok_or(Error::Size(width, height))?;
        resvg::render(&tree, tiny_skia::Transform::from_scale(PIXELS, PIXELS), &mut pixels.as_mut());
        pixels.encode_png().map_err(|e| Error::Pack(e.to_string()))
    }
}

#[cfg(all(test, feature = "png"))]
mod tests {
    use super::of_svg;

    /// A phase portrait is called "x against ẋ": faces change, and the text ends with a dot above a letter.
    #[test]
    fn a_text_may_end_with_a_dotted_letter() {
        let text = |words: &str| {
            format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"200\" height=\"40\"><text x=\"5\" y=\"25\">{words}</text></svg>")
        };
        let italic = |letter: &str| format!("<tspan font-style=\"italic\">{letter}</tspan>");
        let dotted = of_svg(&text(&format!("{} against {}", italic("x"), italic("x\u{307}")))).expect("a picture");
        let plain = of_svg(&text(&format!("{} against {}", italic("x"), italic("x")))).expect("a picture");
        assert_ne!(dotted, plain, "the rate is told from its coordinate");
        let behind = |unit: &str| of_svg(&text(&format!("{}{unit}", italic("x\u{307}")))).expect("a picture");
        assert_ne!(behind(", m/s"), behind("/s"), "what stands behind the letter is drawn");
    }
}

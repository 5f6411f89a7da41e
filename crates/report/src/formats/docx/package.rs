//! The container: parts of the package, styles, a zip archive of them. Instants of the archive are those of its format's beginning: same input, same bytes.

use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;

/// Width between the margins of a page A4, EMU: 210 − 30 − 15 mm.
const WIDTH: u64 = 165 * 36_000;
/// Greatest height of a picture, EMU.
const HEIGHT: u64 = 170 * 36_000;

const MAIN: &str = "http://schemas.openxmlformats.org/wordprocessingml/2006/main";
const MATH: &str = "http://schemas.openxmlformats.org/officeDocument/2006/math";
const LINKS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const DRAWING: &str = "http://schemas.openxmlformats.org/drawingml/2006/main";
const PLACED: &str = "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing";
const PICTURE: &str = "http://schemas.openxmlformats.org/drawingml/2006/picture";
const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";

const TYPES: &str = "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default Extension=\"rels\" \
ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"xml\" ContentType=\"application/xml\"/><Default Extension=\"png\" \
ContentType=\"image/png\"/><Override PartName=\"/word/document.xml\" ContentType=\"application/vnd.openxmlformats-officedocument.wordprocessingml.document.main+xml\"/>\
<Override PartName=\"/word/styles.xml\" ContentType=\"application/vnd.openxmlformats-officedocument.wordprocessingml.styles+xml\"/><Override \
PartName=\"/word/footer1.xml\" ContentType=\"application/vnd.openxmlformats-officedocument.wordprocessingml.footer+xml\"/></Types>";

/// A link of a part to another: number, kind, target.
fn link(id: &str, kind: &str, target: &str) -> String {
    format!("<Relationship Id=\"{id}\" Type=\"{LINKS}/{kind}\" Target=\"{target}\"/>")
}

fn links(list: &[String]) -> String {
    format!("{HEAD}<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">{}</Relationships>", list.concat())
}

/// `word/document.xml` around its paragraphs: A4 with margins of 30, 15, 20 and 20 mm, the page number below.
pub(super) fn document(body: &str) -> String {
    format!(
        "{HEAD}<w:document xmlns:w=\"{MAIN}\" xmlns:m=\"{MATH}\" xmlns:r=\"{LINKS}\" xmlns:wp=\"{PLACED}\" xmlns:a=\"{DRAWING}\" xmlns:pic=\"{PICTURE}\"><w:body>{body}\
         <w:sectPr><w:footerReference w:type=\"default\" r:id=\"footer\"/><w:pgSz w:w=\"11906\" w:h=\"16838\"/><w:pgMar w:top=\"1134\" w:right=\"850\" w:bottom=\"1134\" \
         w:left=\"1701\" w:header=\"567\" w:footer=\"567\" w:gutter=\"0\"/><w:titlePg/></w:sectPr></w:body></w:document>"
    )
}

/// A picture in the line. Its size stands in the file of the picture and is put in by [`pack`].
pub(super) fn drawing(id: usize, file: &str, words: &str) -> String {
    format!(
        "<w:drawing><wp:inline distT=\"0\" distB=\"0\" distL=\"0\" distR=\"0\"><wp:extent cx=\"{{cx {file}}}\" cy=\"{{cy {file}}}\"/><wp:docPr id=\"{id}\" name=\"{file}\" \
         descr=\"{words}\"/><a:graphic><a:graphicData uri=\"{PICTURE}\"><pic:pic><pic:nvPicPr><pic:cNvPr id=\"{id}\" name=\"{file}\"/><pic:cNvPicPr/></pic:nvPicPr>\
         <pic:blipFill><a:blip r:embed=\"{file}\"/><a:stretch><a:fillRect/></a:stretch></pic:blipFill><pic:spPr><a:xfrm><a:off x=\"0\" y=\"0\"/><a:ext cx=\"{{cx {file}}}\" \
         cy=\"{{cy {file}}}\"/></a:xfrm><a:prstGeom prst=\"rect\"><a:avLst/></a:prstGeom></pic:spPr></pic:pic></a:graphicData></a:graphic></wp:inline></w:drawing>"
    )
}

/// Width and height of a PNG in pixels, from its header.
fn pixels(png: &[u8]) -> Option<[u64; 2]> {
    let number = |at: usize| Some(u64::from(u32::from_be_bytes(png.get(at..at + 4)?.try_into().ok()?)));
    Some([number(16)?.max(1), number(20)?.max(1)])
}

/// EMU of a picture of two pixels a point, within the page.
fn extent(png: &[u8]) -> [u64; 2] {
    let [w, h] = pixels(png).unwrap_or([4, 3]);
    // 12700 EMU a point; pictures are drawn at two pixels a unit of 1/96 inch
    let (natural, tall) = (w * 4762, h * 4762);
    let width = natural.min(WIDTH);
    let height = tall * width / natural;
    if height <= HEIGHT { [width, height] } else { [width * HEIGHT / height, HEIGHT] }
}

/// The text and its pictures as the bytes of the file.
pub(super) fn pack(text: &str, pictures: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut text = text.to_owned();
    let mut own = vec![link("styles", "styles", "styles.xml"), link("footer", "footer", "footer1.xml")];
    for (name, png) in pictures {
        let [cx, cy] = extent(png);
        text = text.replace(&format!("{{cx {name}}}"), &cx.to_string()).replace(&format!("{{cy {name}}}"), &cy.to_string());
        own.push(link(name, "image", &format!("media/{name}")));
    }
    let mut archive = Archive::default();
    archive.add("[Content_Types].xml", format!("{HEAD}{TYPES}").as_bytes());
    archive.add("_rels/.rels", links(&[link("document", "officeDocument", "word/document.xml")]).as_bytes());
    archive.add("word/document.xml", text.as_bytes());
    archive.add("word/_rels/document.xml.rels", links(&own).as_bytes());
    archive.add("word/styles.xml", format!("{HEAD}{}", styles()).as_bytes());
    archive.add("word/footer1.xml", footer().as_bytes());
    for (name, png) in pictures {
        archive.add(&format!("word/media/{name}"), png);
    }
    archive.close()
}

fn footer() -> String {
    let field = |kind: &str| format!("<w:r><w:fldChar w:fldCharType=\"{kind}\"/></w:r>");
    let number =
        format!("{}<w:r><w:instrText>PAGE</w:instrText></w:r>{}<w:r><w:t>1</w:t></w:r>{}", field("begin"), field("separate"), field("end"));
    format!("{HEAD}<w:ftr xmlns:w=\"{MAIN}\"><w:p><w:pPr><w:jc w:val=\"center\"/></w:pPr>{number}</w:p></w:ftr>")
}

/// Name, heading of the outline or none, properties of the paragraph, of its letters.
const STYLES: [(&str, &str, &str); 23] = [
    ("Title", "<w:spacing w:after=\"240\"/><w:jc w:val=\"center\"/>", "<w:b/><w:sz w:val=\"36\"/>"),
    ("Heading1", "<w:keepNext/><w:spacing w:before=\"360\" w:after=\"160\"/><w:outlineLvl w:val=\"0\"/>", "<w:b/><w:sz w:val=\"32\"/>"),
    ("Heading2", "<w:keepNext/><w:spacing w:before=\"280\" w:after=\"120\"/><w:outlineLvl w:val=\"1\"/>", "<w:b/><w:sz w:val=\"28\"/>"),
    ("Heading3", "<w:keepNext/><w:spacing w:before=\"200\" w:after=\"80\"/><w:outlineLvl w:val=\"2\"/>", "<w:b/><w:sz w:val=\"26\"/>"),
    ("Formula", "<w:spacing w:before=\"60\" w:after=\"60\"/><w:jc w:val=\"center\"/>", ""),
    ("FormulaNumber", "<w:spacing w:before=\"60\" w:after=\"60\"/><w:jc w:val=\"right\"/>", ""),
    ("TableCaption", "<w:keepNext/><w:spacing w:before=\"160\" w:after=\"60\"/>", ""),
    ("TableText", "<w:spacing w:before=\"0\" w:after=\"0\"/>", "<w:sz w:val=\"22\"/>"),
    ("TableNumber", "<w:spacing w:before=\"0\" w:after=\"0\"/><w:jc w:val=\"right\"/>", "<w:sz w:val=\"22\"/>"),
    ("TableEnd", "<w:spacing w:before=\"0\" w:after=\"120\"/>", "<w:sz w:val=\"12\"/>"),
    ("Picture", "<w:keepNext/><w:spacing w:before=\"160\" w:after=\"60\"/><w:jc w:val=\"center\"/>", ""),
    ("FigureCaption", "<w:spacing w:after=\"200\"/><w:jc w:val=\"center\"/>", ""),
    ("FrontLine", "<w:spacing w:after=\"60\"/><w:jc w:val=\"center\"/>", ""),
    ("FrontKind", "<w:spacing w:before=\"2600\" w:after=\"240\"/><w:jc w:val=\"center\"/>", "<w:b/><w:caps/><w:sz w:val=\"36\"/>"),
    ("FrontSubject", "<w:spacing w:after=\"240\"/><w:jc w:val=\"center\"/>", "<w:b/><w:sz w:val=\"30\"/>"),
    ("FrontPerson", "<w:spacing w:before=\"240\"/><w:jc w:val=\"right\"/>", ""),
    ("FrontBelow", "<w:spacing w:before=\"2600\"/><w:jc w:val=\"center\"/>", ""),
    ("ContentsTitle", "<w:spacing w:after=\"160\"/><w:jc w:val=\"center\"/>", "<w:b/><w:sz w:val=\"32\"/>"),
    ("TOC1", "<w:spacing w:after=\"40\"/>", ""),
    ("TOC2", "<w:spacing w:after=\"40\"/><w:ind w:left=\"360\"/>", ""),
    (
        "Listing",
        "<w:spacing w:before=\"0\" w:after=\"0\"/>",
        "<w:rFonts w:ascii=\"Courier New\" w:hAnsi=\"Courier New\" w:cs=\"Courier New\"/><w:sz w:val=\"16\"/>",
    ),
    ("Footnote", "<w:spacing w:before=\"240\"/>", "<w:sz w:val=\"16\"/>"),
    ("Verdict", "<w:jc w:val=\"center\"/>", ""),
];

/// The names that programs know for headings and lists of contents.
fn known(name: &str) -> String {
    match name.strip_prefix("Heading").map(|n| format!("heading {n}")).or_else(|| name.strip_prefix("TOC").map(|n| format!("toc {n}"))) {
        Some(known) => known,
        None => name.to_owned(),
    }
}

fn styles() -> String {
    let mut out = format!(
        "<w:styles xmlns:w=\"{MAIN}\"><w:docDefaults><w:rPrDefault><w:rPr><w:rFonts w:ascii=\"Times New Roman\" w:hAnsi=\"Times New Roman\" w:cs=\"Times New Roman\"/>\
         <w:sz w:val=\"26\"/></w:rPr></w:rPrDefault><w:pPrDefault><w:pPr><w:spacing w:after=\"120\" w:line=\"276\" w:lineRule=\"auto\"/></w:pPr></w:pPrDefault></w:docDefaults>\
         <w:style w:type=\"paragraph\" w:default=\"1\" w:styleId=\"Normal\"><w:name w:val=\"Normal\"/></w:style>"
    );
    for (name, paragraph, letters) in STYLES {
        out.push_str(&format!(
            "<w:style w:type=\"paragraph\" w:styleId=\"{name}\"><w:name w:val=\"{}\"/><w:basedOn w:val=\"Normal\"/><w:next w:val=\"Normal\"/><w:qFormat/><w:pPr>{paragraph}</w:pPr><w:rPr>{letters}</w:rPr></w:style>",
            known(name)
        ));
    }
    let line = |side: &str| format!("<w:{side} w:val=\"single\" w:sz=\"4\" w:space=\"0\" w:color=\"auto\"/>");
    let lines: String = ["top", "left", "bottom", "right", "insideH", "insideV"].map(line).concat();
    out.push_str(&format!(
        "<w:style w:type=\"table\" w:styleId=\"Grid\"><w:name w:val=\"Table Grid\"/><w:tblPr><w:tblBorders>{lines}</w:tblBorders></w:tblPr></w:style></w:styles>"
    ));
    out
}

/// A zip archive in memory (PKWARE APPNOTE 6.3).
#[derive(Default)]
struct Archive {
    out: Vec<u8>,
    directory: Vec<u8>,
    count: u16,
}

/// 1 January 1980, the first day that the format knows.
const DAY: u16 = 0x21;

impl Archive {
    fn add(&mut self, name: &str, bytes: &[u8]) {
        let mut check = flate2::Crc::new();
        check.update(bytes);
        let packed = deflated(bytes);
        let (method, stored): (u16, &[u8]) = packed.as_deref().map_or((0, bytes), |packed| (8, packed));
        let at = self.out.len() as u32;
        // version 2.0, names in UTF-8, method, time, day, check, sizes, length of the name, no more fields
        let mut entry = Vec::new();
        [20u16, 0x800, method, 0, DAY].iter().for_each(|n| entry.extend(n.to_le_bytes()));
        [check.sum(), stored.len() as u32, bytes.len() as u32].iter().for_each(|n| entry.extend(n.to_le_bytes()));
        [name.len() as u16, 0].iter().for_each(|n| entry.extend(n.to_le_bytes()));
        self.out.extend(0x0403_4b50u32.to_le_bytes());
        self.out.extend(&entry);
        self.out.extend(name.as_bytes());
        self.out.extend(stored);
        self.directory.extend(0x0201_4b50u32.to_le_bytes());
        self.directory.extend(20u16.to_le_bytes());
        self.directory.extend(&entry);
        // no remark, disk 0, no attributes, place of the entry
        self.directory.extend([0u8; 10]);
        self.directory.extend(at.to_le_bytes());
        self.directory.extend(name.as_bytes());
        self.count += 1;
    }

    fn close(mut self) -> Vec<u8> {
        let at = self.out.len() as u32;
        self.out.extend(&self.directory);
        self.out.extend(0x0605_4b50u32.to_le_bytes());
        [0u16, 0, self.count, self.count].iter().for_each(|n| self.out.extend(n.to_le_bytes()));
        [self.directory.len() as u32, at].iter().for_each(|n| self.out.extend(n.to_le_bytes()));
        self.out.extend(0u16.to_le_bytes());
        self.out
    }
}

/// The bytes without what repeats, where that is shorter.
fn deflated(bytes: &[u8]) -> Option<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).ok()?;
    encoder.finish().ok().filter(|packed| packed.len() < bytes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_archive_holds_what_was_put_into_it() {
        let bytes = pack("<w:document/>", &[("figure-1.png".into(), vec![7; 40])]);
        assert_eq!(&bytes[..4], b"PK\x03\x04");
        assert_eq!(bytes, pack("<w:document/>", &[("figure-1.png".into(), vec![7; 40])]));
        // the end of the directory counts the parts and knows where the directory begins
        let end = bytes.len() - 22;
        assert_eq!(&bytes[end..end + 4], b"PK\x05\x06");
        assert_eq!(bytes[end + 10], 7);
        let at = u32::from_le_bytes([bytes[end + 16], bytes[end + 17], bytes[end + 18], bytes[end + 19]]) as usize;
        assert_eq!(&bytes[at..at + 4], b"PK\x01\x02");
    }

    #[test]
    fn styles_that_the_text_names_are_there() {
        let text = include_str!("../docx.rs");
        let made = styles();
        for name in text.split("styled(\"").skip(1).filter_map(|rest| rest.split('"').next()).filter(|name| !name.is_empty()) {
            assert!(made.contains(&format!("w:styleId=\"{name}\"")), "{name}");
        }
    }

    #[test]
    fn pictures_stay_within_the_page() {
        let png = |w: u32, h: u32| [vec![0; 16], w.to_be_bytes().to_vec(), h.to_be_bytes().to_vec()].concat();
        for (w, h) in [(100, 100), (4000, 300), (300, 9000), (1, 1)] {
            let [x, y] = extent(&png(w, h));
            assert!(x <= WIDTH && y <= HEIGHT, "{w} {h}: {x} {y}");
        }
    }
}

//! A page of cards: a picture, a title, a line of words, each leading to a page of its own. Nobody who wants calm sees pictures move.

use crate::escape::{address, markup};
use words::Language;

/// A card.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Card {
    /// Its name in the program.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What it is.
    pub words: String,
    /// The page that it leads to.
    pub page: String,
    /// The file of a picture that moves.
    pub moving: Option<String>,
    /// The file of a picture that stands.
    pub still: Option<String>,
}

const STYLE: &str = include_str!("cards.css");

/// The page: title, what it is, cards.
pub fn cards((title, lead): (&str, &str), list: &[Card], language: Language) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"{}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; img-src 'self' file: data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p class=\"lead\">{lead}</p>\n<ul>\n",
        language.code(),
        title = markup(title),
        lead = markup(lead),
    );
    list.iter().for_each(|card| out.push_str(&one(card)));
    out + "</ul>\n</body>\n</html>\n"
}

fn one(card: &Card) -> String {
    let alt = markup(&card.title);
    let picture = match (&card.moving, &card.still) {
        (Some(moving), Some(still)) => format!(
            "<picture><source media=\"(prefers-reduced-motion: reduce), print\" srcset=\"{}\"><img src=\"{}\" alt=\"{alt}\" loading=\"lazy\"></picture>",
            address(still),
            address(moving)
        ),
        (Some(only), None) | (None, Some(only)) => format!("<img src=\"{}\" alt=\"{alt}\" loading=\"lazy\">", address(only)),
        (None, None) => String::new(),
    };
    format!(
        "<li><a href=\"{}\"><div class=\"picture\">{picture}</div><h2>{alt}</h2></a><p>{}</p><code>{}</code></li>\n",
        address(&card.page),
        markup(&card.words),
        markup(&card.name)
    )
}

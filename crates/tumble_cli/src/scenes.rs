//! `tumble scenes`: the scenes that come with the program.

use tumble_scene::shipped::SHIPPED;

use crate::failure::{Exit, Failure};
use crate::figure::{Column, one_line, table};
use crate::page::Page;

/// Prints a line per shipped scene: its name and what it shows.
pub fn scenes(page: &mut Page) -> Result<Exit, Failure> {
    let mut rows = Vec::new();
    for shipped in SHIPPED {
        rows.push(vec![shipped.name.to_owned(), one_line(shipped.load_any()?.about())]);
    }
    for line in table(&[Column::Left, Column::Left], &rows) {
        page.line(line);
    }
    Ok(Exit::Fine)
}

//! Tables and paragraphs in Markdown.

/// An aligned table; columns for which `is_figure` holds stand at the right.
pub fn table(headings: &[&str], is_figure: impl Fn(usize) -> bool, lines: &[Vec<String>]) -> String {
    let wide = |column: usize| {
        let heading = headings[column].chars().count();
        lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0).max(heading).max(2)
    };
    let widths: Vec<usize> = (0..headings.len()).map(wide).collect();
    let line = |cells: Vec<&str>| {
        let padded = cells.into_iter().enumerate().map(|(column, cell)| {
            let width = widths[column];
            if is_figure(column) { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
        });
        format!("| {} |\n", padded.collect::<Vec<_>>().join(" | "))
    };
    let mut text = line(headings.to_vec());
    let rule = |column: usize| {
        let dashes = "-".repeat(widths[column] + 1);
        if is_figure(column) { format!("{dashes}:") } else { format!("{dashes}-") }
    };
    text += &format!("|{}|\n", (0..headings.len()).map(rule).collect::<Vec<_>>().join("|"));
    lines.iter().for_each(|cells| text += &line(cells.iter().map(String::as_str).collect()));
    text
}

/// The same from lines of text: cells are separated by bars, and a column whose heading begins with `>` holds figures.
pub fn rows(headings: &str, rows: impl IntoIterator<Item = String>) -> String {
    let headings: Vec<&str> = headings.split(" | ").collect();
    let names: Vec<&str> = headings.iter().map(|heading| heading.trim_start_matches('>')).collect();
    let cells = |row: String| row.split(" | ").map(str::to_owned).collect();
    let lines: Vec<Vec<String>> = rows.into_iter().map(cells).collect();
    table(&names, |column| headings[column].starts_with('>'), &lines)
}

/// Breaks a text into lines of at most `width` characters.
pub(super) fn fill(text: &str, width: usize) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last().map_or(0, |line| line.chars().count());
        if line > 0 && line + 1 + word.chars().count() > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_aligned() {
        let text = rows("name | >ms | fault", ["`a` | 1.25 | ".to_owned(), "another | 12.5 | none".to_owned()]);
        let expected = "| name    |   ms | fault |\n\
                        |---------|-----:|-------|\n\
                        | `a`     | 1.25 |       |\n\
                        | another | 12.5 | none  |\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn lines_are_filled_and_no_word_is_lost() {
        let text = "one two three four five six seven";
        let filled = fill(text, 9);
        assert!(filled.lines().all(|line| line.len() <= 9), "{filled}");
        assert_eq!(filled.split_whitespace().collect::<Vec<_>>(), text.split_whitespace().collect::<Vec<_>>());
    }
}

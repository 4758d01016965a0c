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
    fn lines_are_filled_and_no_word_is_lost() {
        let text = "one two three four five six seven";
        let filled = fill(text, 9);
        assert!(filled.lines().all(|line| line.len() <= 9), "{filled}");
        assert_eq!(filled.split_whitespace().collect::<Vec<_>>(), text.split_whitespace().collect::<Vec<_>>());
    }
}

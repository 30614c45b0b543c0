//! Pieces of HTML.

/// A text with what has a meaning in HTML made harmless.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            letter if letter.is_control() && !matches!(letter, '\n' | '\t') => out.push('\u{fffd}'),
            letter => out.push(letter),
        }
    }
    out
}

/// An element around what is HTML already.
pub fn element(tag: &str, class: &str, inside: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    format!("<{tag}{class}>{inside}</{tag}>\n")
}

/// A table of rows of texts; `numbers` are the columns that are aligned to the right.
pub fn table(heads: &[&str], rows: &[Vec<String>], numbers: &[usize]) -> String {
    let cell = |tag: &str, place: usize, text: &str| {
        let class = if numbers.contains(&place) { " class=\"number\"" } else { "" };
        format!("<{tag}{class}>{}</{tag}>", escaped(text))
    };
    let row = |tag: &str, cells: Vec<&str>| {
        let cells: String = cells.into_iter().enumerate().map(|(place, text)| cell(tag, place, text)).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let head = if heads.is_empty() { String::new() } else { format!("<thead>{}</thead>\n", row("th", heads.to_vec())) };
    let body: String = rows.iter().map(|cells| row("td", cells.iter().map(String::as_str).collect())).collect();
    // On a narrow screen the table moves by itself, not the page.
    format!("<div class=\"wide\"><table>\n{head}<tbody>{body}</tbody>\n</table></div>\n")
}

/// Bytes in base 64 (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |place: usize| u32::from(three.get(place).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let letter = char::from(LETTERS[(bits >> (18 - 6 * place) & 63) as usize]);
            out.push(if place > three.len() { '=' } else { letter });
        }
    }
    out
}

/// Words in capitals as a sentence begins: `CONTACT NODES` is `Contact nodes`.
pub fn sentence(capitals: &str) -> String {
    let lower = capitals.to_lowercase();
    let mut letters = lower.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_become_the_letters_of_the_standard() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(texts, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
        assert_eq!(base64(&[255, 254, 253, 0]), "//79AA==");
    }

    #[test]
    fn texts_cannot_break_out() {
        assert_eq!(escaped("<a href=\"x\">&\u{7}"), "&lt;a href=&quot;x&quot;&gt;&amp;\u{fffd}");
        assert_eq!(sentence("TIME STEPS TAKEN"), "Time steps taken");
    }
}

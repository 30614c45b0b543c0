//! The page of a run: whole, well-formed, and true to the run's numbers.

use crate::program::{Desk, put_bar};

/// Tags that have no end.
const EMPTY: [&str; 5] = ["meta", "br", "img", "hr", "link"];

/// Every element that begins ends, in its order; attributes have both quotes.
fn assert_well_formed(html: &str) {
    let mut open: Vec<String> = Vec::new();
    let body = html.strip_prefix("<!DOCTYPE html>").expect("the first line");
    let style = body.find("<style>").zip(body.find("</style>")).expect("a style");
    let (before, after) = (&body[..style.0], &body[style.1 + "</style>".len()..]);
    for part in before.split('<').skip(1).chain(after.split('<').skip(1)) {
        let (tag, _) = part.split_once('>').unwrap_or_else(|| panic!("no end in {}", &part[..part.len().min(60)]));
        assert!(tag.matches('"').count() % 2 == 0, "quotes in {}", &tag[..tag.len().min(80)]);
        let name = tag.trim_start_matches('/').split([' ', '\n', '/']).next().unwrap_or("").to_lowercase();
        if tag.starts_with('/') {
            assert_eq!(open.pop().as_deref(), Some(name.as_str()), "near {}", &part[..part.len().min(60)]);
        } else if !tag.ends_with('/') && !EMPTY.contains(&name.as_str()) {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn a_page_has_everything_in_itself() {
    let desk = Desk::new();
    let more = "PLOT TIME, 1.E-6\nHISTORY TIME, 2.E-7\nHISTORY, BLOCK, 1\nPLOT ELEMENT, VONMISES\nNO DISPLACEMENT, Z, 3\n\
                $ <script>alert(\"a\")</script> & more\n";
    put_bar(&desk, 1e-5, more);
    desk.urto(&["bar.i", "-q"]).with(0);
    let said = desk.urto(&["report", "bar", "-v", "VONMISES", "--filter", "CFC60"]).with(0);
    said.says(&["bar.html: 4 pictures"]);
    let page = desk.text("bar.html");
    assert_well_formed(&page);
    // Nothing is fetched, and nothing of the deck becomes a part of the page.
    for word in ["src=\"http", "href=\"http", "url(", "<script", "@import"] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(page.contains("&lt;script&gt;alert(&quot;a&quot;)&lt;/script&gt; &amp; more"));
    for words in ["<title>A bar</title>", "The run is complete", "VELZ_BLOCK1", "Where the time went", "VONMISES"] {
        assert!(page.contains(words), "{words}");
    }
    // The number of steps is that of the log.
    let log = desk.text("bar.o");
    let steps = log.lines().find_map(|line| line.trim().strip_prefix("TIME STEPS TAKEN")).expect("the closing table");
    let steps = steps.trim_start_matches([' ', '.']);
    assert!(page.contains(&format!("<dt>Time steps</dt><dd>{steps}</dd>")), "{steps}");
    // Extremes are those of the last state.
    let results = desk.results("bar.e");
    let last = results.times().len() - 1;
    let most = results.element("VONMISES", last).expect("values").into_iter().fold(0.0, f64::max);
    assert!(page.contains(&urto::common::numbers::number(most)), "{most}");
    // Pictures are PNGs, curves SVG.
    assert_eq!(page.matches("data:image/png;base64,iVBORw0KGgo").count(), 4);
    assert!(page.matches("<svg ").count() > 5);
}

#[test]
fn what_is_not_there_is_told() {
    let desk = Desk::new();
    put_bar(&desk, 1e-6, "");
    desk.urto(&["report", "bar"]).with(2).says(&["bar.e"]);
    desk.urto(&["bar.i", "-q"]).with(0);
    desk.urto(&["report", "bar.e", "-o", "bar.e"]).with(2);
    desk.urto(&["report", "bar.e", "-o", "page.html"]).with(0);
    std::fs::remove_file(desk.path("bar.o")).expect("the log");
    desk.urto(&["report", "bar.e", "-o", "page.html"]).with(0);
    assert!(desk.text("page.html").contains("There is no print log bar.o"));
    desk.urto(&["report", "bar", "-v", "NOTHING"]).with(0).says(&["warning: not shown", "NOTHING"]);
}

//! The page: its parts in the order in which somebody asks for them.

use super::Material;
use super::html::{base64, element, escaped, sentence, table};
use super::log::{Log, Section};
use crate::common::numbers::number;

const STYLE: &str = include_str!("style.css");

/// Sections of the log that are shown as they stand, beside those that become tables.
const MATERIALS: &str = "MATERIAL DEFINITIONS";
const CONTACT: &str = "CONTACT";

/// The page as HTML.
pub fn compose(material: &Material) -> String {
    let title = if material.title.is_empty() { "A run without a title".to_owned() } else { material.title.clone() };
    let parts = [
        ("result", "How it went", result(material)),
        ("pictures", "What it looks like", pictures(material)),
        ("model", "What was modelled", modelled(material.log.as_ref())),
        ("curves", "Curves", curves(material)),
        ("extremes", "Extremes of the last state", extremes(material)),
        ("contact", "Contact", contact(material.log.as_ref())),
        ("needs", "What the scene did not need, and what it lacked", needs(material.log.as_ref())),
        ("cost", "Where the time went", cost(material.log.as_ref())),
        ("deck", "The deck", deck(material)),
    ];
    let parts: Vec<_> = parts.into_iter().filter(|(.., inside)| !inside.is_empty()).collect();
    let links: String = parts.iter().map(|(id, heading, _)| format!("<a href=\"#{id}\">{heading}</a>\n")).collect();
    let sections: String = parts
        .iter()
        .map(|(id, heading, inside)| format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{inside}</section>\n"))
        .collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"urto {version}\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n\
         <body>\n<header>\n<h1>{title}</h1>\n{banner}<nav>\n{links}</nav>\n</header>\n<main>\n{sections}</main>\n\
         {footer}</body>\n</html>\n",
        version = env!("CARGO_PKG_VERSION"),
        title = escaped(&title),
        banner = banner(material),
        footer = footer(material),
    )
}

/// Below the title: when, where, from what.
fn banner(material: &Material) -> String {
    let lines = material.log.iter().flat_map(|log| log.banner.iter().skip(1).take(2));
    let said: Vec<String> = lines.map(|line| escaped(line)).collect();
    if said.is_empty() { String::new() } else { element("p", "faint", &said.join("<br>\n")) }
}

/// How it ended, the most important numbers, and what it warned of.
fn result(material: &Material) -> String {
    let mut out = String::new();
    let log = material.log.as_ref();
    let outcome = log.map(|log| log.outcome.clone()).unwrap_or_default();
    let good = outcome.starts_with("THE RUN IS COMPLETE");
    let words = match (log, outcome.as_str()) {
        (None, _) => format!("There is no print log {}.", material.files.print.display()),
        (_, "") => "The log does not end: the run goes on, or was killed.".to_owned(),
        (_, words) => sentence(words),
    };
    out += &element("p", if good { "outcome" } else { "outcome bad" }, &escaped(&words));
    let fact = |(name, value): (String, String)| {
        format!("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(&name), escaped(&value))
    };
    let facts: String = facts(material).into_iter().map(fact).collect();
    out += &element("dl", "facts", &facts);
    for [words, advice] in log.iter().flat_map(|log| &log.warnings) {
        let advice = if advice.is_empty() { String::new() } else { element("p", "faint", &escaped(advice)) };
        out += &element("div", "warning", &(element("p", "", &escaped(words)) + &advice));
    }
    for reason in &material.missing {
        out += &element("p", "faint", &format!("Not shown: {}", escaped(reason)));
    }
    out
}

/// Names and values of the most important numbers.
fn facts(material: &Material) -> Vec<(String, String)> {
    let mut facts = Vec::new();
    let log = material.log.as_ref();
    let all: Vec<(String, String)> = log.iter().flat_map(|log| &log.sections).flat_map(Section::leaders).collect();
    for (name, called) in [
        ("NUMBER OF ELEMENTS", "Elements"),
        ("NUMBER OF NODES", "Nodes"),
        ("NUMBER OF MATERIALS", "Materials"),
        ("TIME STEPS TAKEN", "Time steps"),
        ("RELATIVE ERROR OF THE BALANCE", "Error of the energy balance"),
        ("NUMBER OF RANKS", "Ranks"),
    ] {
        facts.extend(
            all.iter().rev().find(|(known, _)| known == name).map(|(_, value)| (called.to_owned(), value.clone())),
        );
    }
    facts.push(("Plot states".to_owned(), material.times.len().to_string()));
    facts.extend(material.times.last().map(|time| ("Time reached".to_owned(), number(*time))));
    let warned = log.map_or(0, |log| log.warnings.len());
    facts.push(("Warnings of the run".to_owned(), warned.to_string()));
    facts
}

fn pictures(material: &Material) -> String {
    let figure = |figure: &super::pictures::Figure| {
        let alt = escaped(&figure.caption);
        let data = base64(&figure.png);
        let inside =
            format!("\n<img alt=\"{alt}\" src=\"data:image/png;base64,{data}\">\n<figcaption>{alt}</figcaption>\n");
        element("figure", if figure.wide { "whole" } else { "" }, &inside)
    };
    let figures: String = material.pictures.iter().map(figure).collect();
    if figures.is_empty() { figures } else { element("div", "figures", &figures) }
}

fn modelled(log: Option<&Log>) -> String {
    let Some(log) = log else { return String::new() };
    let mut out = String::new();
    if let Some(section) = log.section("WHAT IS MODELLED") {
        let row = |line: &String| line.trim().split_once("  ").map(|(a, b)| vec![a.to_owned(), b.trim().to_owned()]);
        let rows: Vec<Vec<String>> = section.lines.iter().skip(1).filter_map(row).collect();
        out += &table(&["Part", "Asked for by"], &rows, &[]);
    }
    if let Some(section) = log.section("PROBLEM DEFINITION") {
        let rows = section.leaders().into_iter().map(|(name, value)| vec![sentence(&name), value]);
        out += "<h3>Control</h3>\n";
        out += &table(&[], &rows.collect::<Vec<_>>(), &[1]);
    }
    if let Some(section) = log.section(MATERIALS) {
        out += "<h3>Materials</h3>\n";
        out += &element("pre", "", &escaped(&section.block()));
    }
    out
}

fn curves(material: &Material) -> String {
    let figure = |plot: &super::curves::Plot| {
        let svg = plot.svg.find("<svg").map_or("", |begin| &plot.svg[begin..]);
        let named = svg.replacen("<svg", &format!("<svg role=\"img\" aria-label=\"{}\"", escaped(&plot.caption)), 1);
        element("figure", "", &named)
    };
    let group = |group: &super::curves::Group| {
        let figures: String = group.plots.iter().map(figure).collect();
        format!("<h3>{}</h3>\n{}", escaped(&group.title), element("div", "figures", &figures))
    };
    material.curves.iter().map(group).collect()
}

fn extremes(material: &Material) -> String {
    let row = |e: &super::extremes::Extreme| {
        let at = |(value, id): (f64, i64)| [number(value), format!("{} {id}", e.of)];
        let [[least, least_at], [greatest, greatest_at]] = [at(e.least), at(e.greatest)];
        vec![e.name.clone(), least, least_at, greatest, greatest_at]
    };
    let rows: Vec<Vec<String>> = material.extremes.iter().map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    table(&["Variable", "Least", "at", "Greatest", "at"], &rows, &[1, 3])
}

/// Numbers of what contact had to do.
fn contact(log: Option<&Log>) -> String {
    let leaders = log.and_then(|log| log.section(CONTACT)).map(Section::leaders).unwrap_or_default();
    let rows: Vec<Vec<String>> = leaders.into_iter().map(|(name, value)| vec![sentence(&name), value]).collect();
    if rows.is_empty() { String::new() } else { table(&[], &rows, &[1]) }
}

fn needs(log: Option<&Log>) -> String {
    let sections = ["WHAT THE SCENE DID NOT NEED", "WHAT THE SCENE LACKED"];
    let found = sections.into_iter().filter_map(|heading| log?.section(heading));
    found
        .map(|section| {
            format!("<h3>{}</h3>\n{}", sentence(&section.heading), element("pre", "", &escaped(&section.block())))
        })
        .collect()
}

fn cost(log: Option<&Log>) -> String {
    let Some(log) = log else { return String::new() };
    let mut out = String::new();
    for heading in ["WHERE THE TIME WENT", "WHAT A RANK HAS TO DO IN A STEP"] {
        let Some(section) = log.section(heading) else { continue };
        let tabular = |line: &&String| !line.contains(" ...");
        let lines = section.lines.iter().filter(tabular).cloned().collect();
        if heading != "WHERE THE TIME WENT" {
            out += &format!("<h3>{}</h3>\n", sentence(heading));
        }
        out += &element("pre", "", &escaped(&Section { heading: heading.into(), lines }.block()));
    }
    out
}

fn deck(material: &Material) -> String {
    if material.deck.is_empty() {
        return String::new();
    }
    element("pre", "", &escaped(&material.deck.join("\n")))
}

fn footer(material: &Material) -> String {
    let made = |[program, version, date, time]: &[String; 4]| format!("{program} {version}, {date} {time}");
    let records: Vec<String> = material.made_by.iter().map(made).collect();
    let files = &material.files;
    let named = [&files.plot, &files.history, &files.print].into_iter().filter(|path| path.exists());
    let names: Vec<String> = named.map(|path| path.display().to_string()).collect();
    let said = format!(
        "Results and mesh were made by: {}.<br>\nRead from {}.<br>\nThis page was made by urto {}.",
        escaped(&records.join("; ")),
        escaped(&names.join(", ")),
        env!("CARGO_PKG_VERSION")
    );
    element("footer", "", &said)
}

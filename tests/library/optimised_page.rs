//! The page of an optimisation: its sections, and that its numbers are those of what was found.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use cutlab::advanced::optimise::{Optimisation, Optimised};
use cutlab::advanced::report::optimised_page::OptimisedPage;
use cutlab::advanced::report::stone_report::ReportError;
use cutlab::advanced::scoring::constraint::Constraint;
use cutlab::advanced::scoring::evaluator::Evaluator;
use cutlab::advanced::scoring::objective::Objective;
use cutlab::{OptimiseRequest, Progress, Stone};

const SIDE: u32 = 24;
const SAMPLES: u64 = 1 << 11;

fn stone() -> Stone {
    Stone::parse("round-brilliant").expect("a cut")
}

fn more(text: &str) -> Objective {
    Objective::maximise(text.parse().expect("a metric"))
}

fn page(stone: &Stone, request: &OptimiseRequest, look: impl Fn(&Optimisation, &Optimised, &str)) {
    let optimisation = request.prepared(stone).expect("can be optimised");
    let found = optimisation.run(Vec::new(), &|_| (), &()).expect("is optimised");
    let mut page = OptimisedPage::new(stone, request, &optimisation.editor, &found);
    (page.side, page.samples) = (SIDE, SAMPLES);
    page.files = (1..=found.finalists.len()).map(|i| format!("b-{i}.asc")).collect();
    page.command = "cutlab optimise <x>".into();
    look(&optimisation, &found, &page.html(&()).expect("can be made"));
}

/// What a page says, without markup, with one blank between words.
fn words(html: &str) -> String {
    let (mut text, mut is_tag) = (String::new(), false);
    for c in html.chars() {
        match c {
            '<' => is_tag = true,
            '>' => {
                is_tag = false;
                text.push(' ');
            }
            c if !is_tag => text.push(c),
            _ => {}
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('−', "-")
}

/// The words of a row of the table of what was paid.
fn row(html: &str, name: &str) -> String {
    let table = html.split("What was paid for what").nth(1).expect("the section");
    let rows = table.split("<tr").filter(|row| row.contains("scope=\"row\""));
    let of = |row: &str| words(&format!("<tr{}", row.split("</tr>").next().unwrap_or_default()));
    rows.map(of).find(|row| row.split(' ').next() == Some(name)).unwrap_or_else(|| panic!("no row {name}"))
}

/// The drawings of a page, as text.
fn drawings(html: &str) -> Vec<String> {
    let uris = html.split("data:image/svg+xml;base64,").skip(1);
    let of = |rest: &str| STANDARD.decode(rest.split('"').next().unwrap_or_default()).expect("base64");
    uris.map(|rest| String::from_utf8(of(rest)).expect("UTF-8")).collect()
}

fn heads(html: &str) -> Vec<&str> {
    html.split("<h2>").skip(1).map(|rest| rest.split("</h2>").next().unwrap_or_default()).collect()
}

#[test]
fn a_page_of_one_objective_has_every_section_and_the_numbers_that_were_found() {
    let bound = Constraint::at_least("weight_ratio=0.8*start").expect("a bound");
    let request = OptimiseRequest::new([more("iso@0,10")]).evaluations(20).constraint(bound);
    let stone = stone();
    page(&stone, &request, |optimisation, found, html| {
        let sections = [
            "Result",
            "What was asked for",
            "Search",
            "Variables",
            "Before and after",
            "What was paid for what",
            "Tilted",
            "To cut it",
        ];
        assert_eq!(heads(html), sections);
        assert!(html.contains("<a href=\"b-1.asc\">") && html.contains("cutlab optimise &lt;x&gt;"));
        let (said, gain) = (words(html), found.finalists[0].gains[0]);
        for number in [gain.value, gain.start, gain.gain] {
            assert!(said.contains(&number.to_string()), "{number}: {said}");
        }
        assert!(gain.is_significant && said.contains("(significant)"), "{said}");
        assert!(said.contains("weight_ratio at least 0.8 × what the start has"));
        let objective = row(html, "iso@0,10");
        assert!(
            objective.contains(&format!("+{}", gain.gain)) && objective.ends_with("better"),
            "{objective}"
        );
        // other scores, computed here
        let names = ["wlr", "contrast", "spread"];
        let effort = request.effort.samples(SAMPLES);
        let others: Vec<Objective> = names.iter().map(|name| more(name)).collect();
        let solid = &optimisation.editor.solid;
        let evaluator = Evaluator::new(others, Vec::new(), stone.material(), effort, solid).expect("scored");
        let gains =
            evaluator.gains(solid, &[found.finalists[0].edited.solid.clone()]).expect("both have them");
        for (name, gain) in names.iter().zip(&gains[0]) {
            let row = row(html, name);
            for number in [gain.start, gain.value, gain.gain] {
                assert!(row.contains(&number.to_string()), "{number}: {row}");
            }
        }
        assert_eq!(optimisation.degrees.len(), 2);
        // the best so far, two variables, tilt curves of iso alone, one diagram
        assert_eq!(drawings(html).len(), 3 + 1 + 1);
        assert_eq!(html.matches("data:image/png").count(), 3 * 2, "three kinds of picture of two stones");
        assert_eq!(html.matches("<img").count(), html.matches("alt=\"").count());
    });
}

#[test]
fn a_page_of_several_objectives_shows_every_pair_with_front_start_and_kept_designs() {
    let request =
        OptimiseRequest::new([more("iso"), more("fire_streak"), more("weight_ratio")]).evaluations(24);
    page(&stone(), &request, |_, found, html| {
        assert!(heads(html).contains(&"Front") && !heads(html).contains(&"Search"));
        let kept = found.finalists.len();
        assert!(kept > 2 && html.matches("<details").count() == kept);
        let feasible = found.candidates.iter().filter(|c| c.outcome.is_feasible()).count();
        assert!(words(html).contains(&format!("24, of which {feasible} keep the bounds")));
        let drawings = drawings(html);
        for (drawing, title) in drawings.iter().zip(["iso and fire_streak", "iso and weight_ratio"]) {
            let document = roxmltree::Document::parse(drawing).expect("is XML");
            let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
            assert!(texts.contains(&title) && texts.contains(&"start"), "{texts:?}");
            for number in 1..=kept {
                assert!(texts.contains(&number.to_string().as_str()), "{number}: {texts:?}");
            }
            // points that share a place are drawn once
            let points = |colour: &str| {
                let paths = document.descendants().filter(|n| n.attribute("stroke-linecap").is_some());
                let of = paths.filter(|n| n.attribute("stroke") == Some(colour));
                of.filter_map(|n| n.attribute("d")).map(|d| d.matches("h0").count()).sum::<usize>()
            };
            assert!(points("#aab2b9") <= feasible && points("#aab2b9") > feasible / 2);
            assert!(points("#0072b2") <= found.front.len() && points("#0072b2") > 0);
        }
        // three pairs; tilt curves of iso and fire_streak, for the weight does not change; diagrams
        assert_eq!(drawings.len(), 3 + 2 + kept);
        // a kept design that is the start may differ by nothing, without an error
        let moved = found.finalists.iter().filter(|finalist| finalist.candidate != 0).count();
        for name in ["fire_streak", "wlr", "scintillation"] {
            let (row, all) = (row(html, name), 1 + 2 * kept);
            assert!((1 + kept + moved..=all).contains(&row.matches('±').count()), "{name}: {row}");
        }
    });
}

/// The work may be ended at any step of it.
#[test]
fn a_page_can_be_cancelled() {
    struct Cancelled;
    impl Progress for Cancelled {
        fn is_cancelled(&self) -> bool {
            true
        }
    }
    let request = OptimiseRequest::new([more("spread")]).evaluations(3);
    let stone = stone();
    let optimisation = request.prepared(&stone).expect("can be optimised");
    let found = optimisation.run(Vec::new(), &|_| (), &()).expect("is optimised");
    let page = OptimisedPage::new(&stone, &request, &optimisation.editor, &found);
    assert!(matches!(page.html(&Cancelled), Err(ReportError::Cancelled)));
}

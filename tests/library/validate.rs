//! `cutlab validate`: every figure comes out, or says what it lacks.

use cutlab::advanced::batch::validate::{
    CheckContext, CheckReport, FigureOutcome, Verdict, catalogue, csv, only,
};

fn run(part: Option<&str>, seed: u64) -> Vec<FigureOutcome> {
    let lab = CheckContext {
        seed,
        corpus: std::env::var_os("CUTLAB_CORPUS").map(Into::into),
        limits: Default::default(),
    };
    let trials = part.map_or_else(catalogue, |part| only(catalogue(), part));
    let reports: Vec<CheckReport> = trials.into_iter().map(|t| t.run(&lab)).collect();
    reports.into_iter().flat_map(|r| r.outcomes).collect()
}

fn check(outcomes: &[FigureOutcome]) {
    for o in outcomes {
        assert!(
            o.verdict != Verdict::Failed,
            "{}: {:?} for {:?}: {}",
            o.figure.name,
            o.ours,
            o.figure.expected,
            o.why
        );
        assert!(o.verdict == Verdict::Passed || !o.why.is_empty(), "{}", o.figure.name);
        let skips = o.why.contains("CUTLAB_CORPUS") || o.why.starts_with("no /");
        assert_eq!(o.verdict == Verdict::Skipped, skips, "{}: {}", o.figure.name, o.why);
    }
}

/// Geometry and indices, which are quick.
#[test]
fn closed_forms_come_out() {
    let outcomes = [run(Some("geometry"), 1), run(Some("indices"), 1), run(Some("gutter"), 1)].concat();
    assert!(outcomes.len() > 70, "{}", outcomes.len());
    check(&outcomes);
}

#[test]
#[ignore = "every figure, half a minute"]
fn every_figure_comes_out() {
    check(&run(None, 1));
}

#[test]
fn figures_that_need_a_corpus_are_skipped_without_one() {
    let lab = CheckContext { seed: 1, corpus: None, limits: Default::default() };
    let reports: Vec<CheckReport> = only(catalogue(), "SRB").into_iter().map(|t| t.run(&lab)).collect();
    let outcomes: Vec<&FigureOutcome> = reports.iter().flat_map(|r| &r.outcomes).collect();
    assert!(
        outcomes.len() >= 12 && outcomes.iter().all(|o| o.verdict == Verdict::Skipped && o.ours.is_none())
    );
    let table = String::from_utf8(csv(outcomes.into_iter()).expect("a table")).expect("text");
    assert!(table.starts_with("subject,figure,source,kind,relation,expected,"), "{table}");
    assert!(table.lines().skip(1).all(|l| l.contains("skipped") && l.contains("CUTLAB_CORPUS")), "{table}");
}

//! dev
use replan_audit::{output, reader, report};
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let format = reader::Format::of_ending(path.rsplit('.').next().unwrap()).unwrap();
    match reader::read(&text, format) {
        Err(f) => f.iter().for_each(|f| println!("{path}:{f}")),
        Ok(input) => {
            let json = std::env::args().nth(2).as_deref() == Some("json");
            let witness = (std::env::args().nth(2).as_deref() == Some("w"))
                .then(replan_audit::witness::Budget::default);
            match report::audit(
                &input,
                &report::Options { keeps_possible: json, witness, ..Default::default() },
            ) {
                Err(f) => f.iter().for_each(|f| println!("{path}:{f}")),
                Ok(r) if json => println!("{:#}", output::json(&path, &r)),
                Ok(r) => {
                    output::guesses(&path, &input).iter().for_each(|l| println!("{l}"));
                    r.findings.iter().for_each(|f| println!("{}", output::line(&path, f)));
                    output::summary(&r).iter().for_each(|l| println!("{l}"));
                }
            }
        }
    }
}

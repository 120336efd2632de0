//! The best run of each engine, and tables of them.

use std::fmt;

use tumble_bench::Line;

/// The best runs so far, in the order in which they came first.
#[derive(Debug, Default)]
pub struct Results {
    best: Vec<Line>,
    /// Scenes on which tumble's final bits differed between rounds or numbers of threads.
    unsteady: Vec<String>,
}

/// The engine that the others are compared with.
const OURS: &str = "tumble";

impl Results {
    /// Takes in a run.
    pub fn add(&mut self, line: Line) {
        let same_run =
            |known: &Line| known.scene == line.scene && known.engine == line.engine && known.steps == line.steps;
        let differs = self.best.iter().any(|known| same_run(known) && known.fingerprint != line.fingerprint);
        if line.engine == OURS && differs && !self.unsteady.contains(&line.scene) {
            self.unsteady.push(line.scene.clone());
        }
        match self.best.iter_mut().find(|known| same_run(known) && known.threads == line.threads) {
            Some(known) if line.ms_mean < known.ms_mean => *known = line,
            Some(_) => {}
            None => self.best.push(line),
        }
    }

    /// The runs of a scene with so many threads: ours, and those of the peers, fastest first.
    fn group(&self, scene: &str, threads: u32) -> (Option<&Line>, Vec<&Line>) {
        let of_group = |line: &&Line| line.scene == scene && line.threads == threads;
        let mut peers: Vec<&Line> = self.best.iter().filter(of_group).filter(|line| line.engine != OURS).collect();
        peers.sort_by(|one, other| one.ms_mean.total_cmp(&other.ms_mean));
        (self.best.iter().find(|line| of_group(line) && line.engine == OURS), peers)
    }

    fn ratios(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            formatter,
            "| Scene | Threads | Bodies | Contacts | tumble [ms] | Peers [ms] | Ratio | Mean overlap [mm] | Drift [m] |"
        )?;
        writeln!(formatter, "|---|---|---|---|---|---|---|---|---|")?;
        for ours in self.best.iter().filter(|line| line.engine == OURS) {
            let (_, peers) = self.group(&ours.scene, ours.threads);
            let each = |figure: &dyn Fn(&Line) -> String| {
                let peers = peers.iter().map(|line| format!("{} {}", line.engine, figure(line)));
                peers.collect::<Vec<_>>().join(", ")
            };
            let ratio =
                peers.first().map_or_else(|| "–".to_owned(), |peer| format!("**{:.2}**", ours.ms_mean / peer.ms_mean));
            let overlap = |line: &Line| format!("{:.2}", line.mean_overlap * 1e3);
            let drift = |line: &Line| format!("{:.3}", line.top_drift);
            let Line { scene, threads, bodies, contacts, .. } = ours;
            write!(formatter, "| `{scene}` | {threads} | {bodies} | {contacts} | {} | {} ", time(ours), each(&time))?;
            write!(formatter, "| {ratio} | {}; {} ", overlap(ours), each(&overlap))?;
            writeln!(formatter, "| {}; {} |", drift(ours), each(&drift))?;
        }
        Ok(())
    }

    /// Sizes of a series: scenes whose names have a dash.
    fn growth(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut series: Vec<(&str, &str, u32, Vec<&Line>)> = Vec::new();
        for line in &self.best {
            let Some((name, _)) = line.scene.split_once('-') else { continue };
            match series.iter_mut().find(|known| (known.0, known.1, known.2) == (name, &*line.engine, line.threads)) {
                Some(known) => known.3.push(line),
                None => series.push((name, &line.engine, line.threads, vec![line])),
            }
        }
        series.retain(|(.., lines)| lines.len() > 1);
        if series.is_empty() {
            return Ok(());
        }
        writeln!(
            formatter,
            "\n| Series | Threads | Engine | Contacts: ns a step and contact | Growth | Bytes a contact, a body |"
        )?;
        writeln!(formatter, "|---|---|---|---|---|---|")?;
        series.sort_by_key(|(name, _, threads, _)| (*name, *threads));
        for (name, engine, threads, mut lines) in series {
            lines.sort_by_key(|line| line.contacts);
            let cost = |line: &Line| 1e6 * line.ms_mean / line.contacts.max(1) as f64;
            let costs: Vec<String> = lines.iter().map(|line| format!("{}: {:.0}", line.contacts, cost(line))).collect();
            let (small, large) = (lines[0], lines[lines.len() - 1]);
            let growth = cost(large) / cost(small);
            let contact = large.bytes_per_contact.map_or_else(|| "–".to_owned(), |bytes| format!("{bytes:.0}"));
            write!(formatter, "| `{name}` | {threads} | {engine} | {} | {growth:.2} ", costs.join(", "))?;
            writeln!(formatter, "| {contact}, {:.0} |", large.bytes_per_body)?;
        }
        Ok(())
    }
}

/// A step's time with three digits [ms].
fn time(line: &Line) -> String {
    let digits = match line.ms_mean {
        ms if ms >= 10.0 => 1,
        ms if ms >= 1.0 => 2,
        ms if ms >= 0.1 => 3,
        _ => 5,
    };
    format!("{:.digits$}", line.ms_mean)
}

impl fmt::Display for Results {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.ratios(formatter)?;
        self.growth(formatter)?;
        for scene in &self.unsteady {
            writeln!(formatter, "\n**{scene}: tumble's final bits differed between runs.**")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(engine: &str, scene: &str, ms: f64, contacts: usize, fingerprint: u32) -> Line {
        let text =
            format!("{engine},1,{scene},10,1,100,{ms},{ms},{ms},{contacts},0.01,0.001,0.5,2.0,800,96,{fingerprint:x}");
        text.parse().expect("all columns are there")
    }

    #[test]
    fn ratios_are_those_of_the_best_rounds_to_the_fastest_peer() {
        let mut results = Results::default();
        for (engine, ms) in
            [("tumble", 4.0), ("slow", 9.0), ("fast", 5.0), ("tumble", 3.0), ("slow", 6.5), ("fast", 6.0)]
        {
            results.add(line(engine, "pile", ms, 12, 1));
        }
        let row = "| `pile` | 1 | 10 | 12 | 3.00 | fast 5.00, slow 6.50 | **0.60** | 1.00; fast 1.00, slow 1.00 | 0.500; fast 0.500, slow 0.500 |";
        assert_eq!(results.to_string().lines().nth(2), Some(row));
        assert_eq!(results.to_string().lines().count(), 3, "no series, and nothing unsteady");
    }

    #[test]
    fn growth_is_cost_per_contact_of_the_largest_over_the_smallest() {
        let mut results = Results::default();
        results.add(line("tumble", "growth-1000", 0.1, 1000, 1));
        results.add(line("tumble", "growth-100000", 20.0, 100_000, 2));
        let row = "| `growth` | 1 | tumble | 1000: 100, 100000: 200 | 2.00 | 96, 800 |";
        assert_eq!(results.to_string().lines().last(), Some(row));
    }

    #[test]
    fn other_bits_in_another_round_are_told() {
        let mut results = Results::default();
        results.add(line("tumble", "pile", 4.0, 12, 1));
        results.add(line("tumble", "pile", 5.0, 12, 2));
        assert!(results.to_string().contains("pile: tumble's final bits differed"));
    }
}

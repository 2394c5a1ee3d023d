//! What growing a tree costs, each time in a process of its own, and how that compares with another build of this bench.
//!
//! `cargo bench -p espalier-growth --bench growing -- [10k 100k 1M] [--rounds N] [--against PROGRAM]`
//!
//! With `--threads N` it compares one thread with N of this build, by the wall; with `--busy M` beside so many threads that
//! do nothing but keep processors busy.

mod support;

use std::{
    env, fs, hint,
    path::PathBuf,
    process::Command,
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::Instant,
};

use espalier_growth::{NoObserver, ParameterValues, Parameters, Simulation, StepInput, use_clock};
use rayon::ThreadPoolBuilder;

/// Thresholds of shedding: nothing is shed, or a fourteenth of what grows.
const THRESHOLDS: [(&str, f32); 2] = [("nothing shed", 0.0), ("shedding", 0.4)];
/// Says that this process grows one tree, and no more.
const ONE: &str = "--one";

/// One tree that was grown.
#[derive(Clone, Copy)]
struct Grown {
    steps: u32,
    grown: u32,
    living: u32,
    milliseconds: f64,
}

/// Time that this thread has been running, in milliseconds, where the system tells it; else time that has passed.
fn clock(begun: Instant) -> f64 {
    let running = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = running.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begun.elapsed().as_secs_f64() * 1e3, |nanoseconds| nanoseconds / 1e6)
}

fn clock_name() -> &'static str {
    if fs::exists("/proc/thread-self/schedstat").unwrap_or(false) { "processor" } else { "wall" }
}

fn wall(begun: Instant) -> f64 {
    begun.elapsed().as_secs_f64() * 1e3
}

/// Grows a tree to so many living metamers.
fn grow(metamers: u32, shedding_threshold: f32, clock: fn(Instant) -> f64) -> Grown {
    let values = ParameterValues { shedding_threshold, ..ParameterValues::default() };
    let mut simulation = Simulation::new(1, Parameters::new(values).expect("the threshold is in range"));
    simulation.set_metamer_budget(u32::MAX);
    let input = StepInput { autonomous: true, ..StepInput::default() };
    let begun = Instant::now();
    let (before, mut steps) = (clock(begun), 0);
    while simulation.plant().living_count() < metamers {
        simulation.step(&input, &mut NoObserver);
        steps += 1;
    }
    let milliseconds = clock(begun) - before;
    let plant = simulation.plant();
    Grown { steps, grown: plant.metamer_count() as u32, living: plant.living_count(), milliseconds }
}

/// The same in a process of its own, by this build or another; on several threads where a number of them is given.
fn grow_apart(program: &PathBuf, metamers: u32, shedding_threshold: f32, threads: Option<usize>) -> Grown {
    let mut arguments = vec![ONE.to_owned(), metamers.to_string(), shedding_threshold.to_string()];
    arguments.extend(threads.map(|threads| threads.to_string()));
    let output = Command::new(program).args(arguments).output().expect("the program can be started");
    let text = String::from_utf8(output.stdout).expect("numbers are text");
    let numbers: Vec<f64> = text.split_whitespace().map(|n| n.parse().expect("a number")).collect();
    let [steps, grown, living, milliseconds] = numbers[..] else { panic!("{program:?} said {text:?}") };
    Grown { steps: steps as u32, grown: grown as u32, living: living as u32, milliseconds }
}

/// 10k and 1M are numbers too.
fn number(word: &str) -> Option<u32> {
    let thousands = word.replace('k', "000").replace('M', "000000");
    thousands.parse().ok()
}

/// Prints how long trees take on one thread and on several, by the wall, beside so many others that keep processors busy.
fn compare_threads(sizes: &[u32], rounds: u32, threads: usize, busy: usize) {
    let own = env::current_exe().expect("this program has a path");
    let done = AtomicBool::new(false);
    thread::scope(|scope| {
        for _ in 0..busy {
            scope.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    hint::spin_loop();
                }
            });
        }
        println!("Medians of {rounds} rounds, wall time, nothing shed, {busy} busy threads beside it.\n");
        println!("| tree | one thread, ms | {threads} threads, ms | one of several |");
        println!("|---|---|---|---|");
        for &size in sizes {
            let mut times = [Vec::new(), Vec::new()];
            for _ in 0..rounds {
                for (times, threads) in times.iter_mut().zip([1, threads]) {
                    times.push(grow_apart(&own, size, 0.0, Some(threads)).milliseconds);
                }
            }
            let [one, several] = times.map(|mut times| {
                times.sort_unstable_by(f64::total_cmp);
                times[times.len() / 2]
            });
            println!("| {size} | {one:.1} | {several:.1} | {:.2} |", one / several);
        }
        done.store(true, Ordering::Relaxed);
    });
}

fn main() {
    let mut words = env::args().skip(1);
    let (mut sizes, mut rounds, mut against) = (Vec::new(), 5, None);
    let (mut threads, mut busy) = (None, 0);
    while let Some(word) = words.next() {
        match word.as_str() {
            // Cargo says this to every bench.
            "--bench" => {}
            "--rounds" => rounds = words.next().and_then(|n| number(&n)).expect("--rounds takes a number"),
            "--against" => against = Some(PathBuf::from(words.next().expect("--against takes a program"))),
            "--threads" => {
                threads = Some(words.next().and_then(|n| n.parse().ok()).expect("--threads takes a number"))
            }
            "--busy" => busy = words.next().and_then(|n| n.parse().ok()).expect("--busy takes a number"),
            ONE => {
                let metamers = words.next().and_then(|n| number(&n)).expect("a size");
                let threshold = words.next().and_then(|n| n.parse().ok()).expect("a threshold");
                let threads: Option<usize> = words.next().and_then(|n| n.parse().ok());
                let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(1)).use_current_thread();
                pool.build_global().expect("the pool is made once");
                use_clock(support::passed);
                let clock = if threads.is_some() { wall } else { clock };
                let Grown { steps, grown, living, milliseconds } = grow(metamers, threshold, clock);
                return println!("{steps} {grown} {living} {milliseconds}");
            }
            size => sizes.push(number(size).expect("a size is a number, like 100k")),
        }
    }
    if sizes.is_empty() {
        sizes = vec![10_000, 100_000, 1_000_000];
    }
    if let Some(threads) = threads {
        return compare_threads(&sizes, rounds, threads, busy);
    }
    let own = env::current_exe().expect("this program has a path");
    let programs: Vec<PathBuf> = [own].into_iter().chain(against).collect();
    let kinds = || sizes.iter().flat_map(|&size| THRESHOLDS.map(|threshold| (size, threshold)));
    // Round by round, so that all rows have the same luck with the machine.
    let mut best: Vec<Vec<Grown>> = Vec::new();
    for round in 0..rounds {
        for (row, (size, (_, threshold))) in kinds().enumerate() {
            let tried: Vec<Grown> =
                programs.iter().map(|one| grow_apart(one, size, threshold, None)).collect();
            if round == 0 {
                best.push(tried);
                continue;
            }
            for (best, tried) in best[row].iter_mut().zip(tried) {
                best.milliseconds = best.milliseconds.min(tried.milliseconds);
            }
        }
    }
    println!("Best of {rounds} rounds, one thread, {} time.\n", clock_name());
    let ratio = if programs.len() > 1 { " other | of other |" } else { "" };
    println!("| tree | steps | grown | living | ms | µs each grown | µs each living |{ratio}");
    println!("|---|---|---|---|---|---|---|{}", if programs.len() > 1 { "---|---|" } else { "" });
    for ((size, (name, _)), best) in kinds().zip(&best) {
        let Grown { steps, grown, living, milliseconds: ms } = best[0];
        let each = |count: u32| ms * 1e3 / f64::from(count);
        let row = format!("{size}, {name} | {steps} | {grown} | {living} | {ms:.1}");
        print!("| {row} | {:.2} | {:.2} |", each(grown), each(living));
        if let Some(other) = best.get(1) {
            print!(" {:.1} | {:.2} |", other.milliseconds, ms / other.milliseconds);
        }
        println!();
    }
}

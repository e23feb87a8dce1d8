//! What a photograph costs: from a file to linear numbers, a picture on the screen, and r and h.
//!
//! Times on their own say more of the machine than of the program, so the first lines hold each against the bare
//! decoder or a plain loop over the same data in the same run: processor time of all threads, the least of several
//! rounds in turns. The bars: a JPEG to statistics and preview at most 1.35 × its decoder with at most 64 MB beside the
//! decoded picture; the first look within 0.6 of an opening; a 16-bit TIFF at its decoder's own speed.

#![expect(clippy::print_stdout, reason = "the ratios are what it is run for")]

use std::fs;
use std::hint::black_box;
use std::io::Cursor;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use divan::Bencher;
use edgewise::color::RgbSpace;
use edgewise::fresnel::{CosTheta, Weights, hoffman};
use edgewise::photo::{
    Area, AreaStatistics, Circle, MatchPixels, MatchRequest, OpenOptions, Photo, find_ball, snap_circle, solve,
};
use rayon::prelude::*;
use zune_core::bytestream::ZCursor;

fn main() {
    println!("processor time of all threads, least of {ROUNDS} rounds");
    jpeg_ratios("60-megapixel JPEG", jpeg_of([9504, 6336]), [9504, 6336]);
    jpeg_ratios("24-megapixel JPEG", jpeg().to_vec(), SIZE);
    tiff_ratios();
    fit_ratios();
    divan::main();
}

const SIZE: [u32; 2] = [6000, 4000];
const ROUNDS: usize = 5;

/// What a camera sees, roughly: detail at every scale, which compresses to a quarter of a byte a pixel.
fn value(x: u32, y: u32, channel: u32) -> f64 {
    let hash = |x: u32, y: u32| {
        let mixed = (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77) ^ channel).wrapping_mul(0xC2B2_AE3D);
        f64::from((mixed ^ (mixed >> 15)).wrapping_mul(0x2545_F491) >> 8) / f64::from(1 << 24)
    };
    let octave = |level: u32| {
        let size = f64::from(1_u32 << level);
        let (x, y) = (f64::from(x) / size, f64::from(y) / size);
        let (s, t) = (x.fract(), y.fract());
        let at = |dx: u32, dy: u32| hash(x as u32 + dx, y as u32 + dy + level * 7919) - 0.5;
        let top = at(0, 0) * (1.0 - s) + at(1, 0) * s;
        (top * (1.0 - t) + (at(0, 1) * (1.0 - s) + at(1, 1) * s) * t) * size.powf(0.4)
    };
    0.5 + 0.06 * [1, 3, 5, 7, 9].map(octave).iter().sum::<f64>()
}

fn picture([width, height]: [u32; 2]) -> Vec<u8> {
    let row =
        |y: u32| (0..width).flat_map(move |x| [0, 1, 2].map(|c| (value(x, y, c) * 255.0).clamp(0.0, 255.0) as u8));
    (0..height).into_par_iter().flat_map_iter(row).collect()
}

/// Quality 93 with the colours at half resolution, as cameras write it.
fn jpeg_of(size: [u32; 2]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut file, 93);
    encoder.set_sampling_factor(jpeg_encoder::SamplingFactor::F_2_2);
    let [width, height] = size.map(|side| side as u16);
    encoder.encode(&picture(size), width, height, jpeg_encoder::ColorType::Rgb).expect("a picture");
    file
}

fn jpeg() -> &'static [u8] {
    static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| jpeg_of(SIZE));
    &FILE
}

fn tiff16() -> Vec<u8> {
    let wide: Vec<u16> = picture(SIZE).into_iter().map(|code| u16::from(code) * 257).collect();
    let mut file = Cursor::new(Vec::new());
    let mut encoder = tiff::encoder::TiffEncoder::new(&mut file).expect("memory");
    encoder.write_image::<tiff::encoder::colortype::RGB16>(SIZE[0], SIZE[1], &wide).expect("a picture");
    file.into_inner()
}

fn go_on(_: f32) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn bare_jpeg(file: &[u8]) -> usize {
    zune_jpeg::JpegDecoder::new(ZCursor::new(file)).decode().expect("a JPEG").len()
}

fn bare_tiff(file: &[u8]) -> bool {
    let limits = tiff::decoder::Limits::unlimited();
    let mut decoder = tiff::decoder::Decoder::new(Cursor::new(file)).expect("a TIFF").with_limits(limits);
    matches!(decoder.read_image(), Ok(tiff::decoder::DecodingResult::U16(_)))
}

fn read(name: &str, file: &[u8]) -> Photo {
    Photo::from_bytes(name, file, &mut go_on).expect("a photograph")
}

fn statistics(photo: &Photo) -> AreaStatistics {
    AreaStatistics::of(photo, Area::rectangle(2000.0, 1000.0, 1000.0, 1000.0))
}

/// A whole photograph: what is wrong with it, what a million pixels of it hold, what the screen shows.
fn ours(name: &str, file: &[u8]) -> f64 {
    let photo = read(name, file);
    let statistics = statistics(&photo);
    black_box(photo.preview(2048));
    statistics.trimmed_mean[0]
}

/// What something takes.
#[derive(Clone, Copy)]
struct Cost {
    /// Processor time of all threads.
    processor: Duration,
    /// Time on the clock.
    clock: Duration,
}

impl Cost {
    /// Of one call, from as many as take a second.
    fn of<T>(f: &mut dyn FnMut() -> T) -> Self {
        let (start, processor, mut calls) = (Instant::now(), processor_time(), 0);
        while calls == 0 || start.elapsed() < Duration::from_secs(1) {
            black_box(f());
            calls += 1;
        }
        Self { processor: (processor_time() - processor) / calls, clock: start.elapsed() / calls }
    }

    fn least(self, other: Self) -> Self {
        Self { processor: self.processor.min(other.processor), clock: self.clock.min(other.clock) }
    }
}

/// Processor time of all threads of this process so far. The system counts in hundredths of a second.
fn processor_time() -> Duration {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    Duration::from_millis(10 * ticks.filter_map(|ticks| ticks.parse::<u64>().ok()).sum::<u64>())
}

/// The least costs of two things in turns.
fn against<A, B>(mut ours: impl FnMut() -> A, mut bare: impl FnMut() -> B) -> [Cost; 2] {
    let rounds = (0..ROUNDS).map(|_| [Cost::of(&mut ours), Cost::of(&mut bare)]);
    rounds.reduce(|a, b| [a[0].least(b[0]), a[1].least(b[1])]).expect("a round")
}

fn print_ratio(what: &str, [ours, bare]: [Duration; 2], than: &str) {
    let ratio = ours.as_secs_f64() / bare.as_secs_f64();
    println!("{what}: {ours:.1?}, {ratio:.2} × {than} ({bare:.1?})");
}

fn jpeg_ratios(what: &str, file: Vec<u8>, [width, height]: [u32; 2]) {
    let decoded = 3 * u64::from(width * height);
    println!("{what} of {:.2} bytes a pixel", 3.0 * file.len() as f64 / decoded as f64);
    let costs = against(|| ours("photo.jpg", &file), || bare_jpeg(&file));
    let than = "the bare decoder";
    print_ratio("  to statistics of 1 megapixel and preview", costs.map(|cost| cost.processor), than);
    let photo = read("photo.jpg", &file);
    let (statistics, preview) = (Cost::of(&mut || statistics(&photo)), Cost::of(&mut || photo.preview(2048)));
    println!("  of which statistics {:.1?}, preview {:.1?}", statistics.processor, preview.processor);
    drop(photo);

    let before = memory("VmRSS");
    // Makes the kernel forget the largest size so far.
    let _ = fs::write("/proc/self/clear_refs", "5");
    black_box(ours("photo.jpg", &file));
    let beside = memory("VmHWM").saturating_sub(before).saturating_sub(decoded);
    println!("  memory beside the decoded picture at most: {} MB", beside / 1_000_000);

    let folder = std::env::temp_dir().join(format!("edgewise-bench-{}", std::process::id()));
    let _ = fs::create_dir(&folder);
    let path = folder.join("photo.jpg");
    fs::write(&path, &file).expect("a folder to write in");
    first_look(&path);
    let _ = fs::remove_dir_all(&folder);
}

/// In seconds on the clock: a person waits for it.
fn first_look(path: &Path) {
    let rounds = (0..ROUNDS).map(|_| {
        let (start, mut seen) = (Instant::now(), Duration::ZERO);
        let mut look = |_| seen = start.elapsed();
        Photo::open_showing(path, &OpenOptions::default(), &mut look, &mut go_on).expect("a photograph");
        [seen, start.elapsed()]
    });
    let [seen, whole] = rounds.min_by_key(|[_, whole]| *whole).unwrap_or_default();
    print_ratio("  first look on the clock", [seen, whole], "the whole opening");
}

/// Beside the samples a TIFF is hashed, which takes as long as copying it: another processor does that.
fn tiff_ratios() {
    let file = tiff16();
    let costs = against(|| read("photo.tif", &file).width, || bare_tiff(&file));
    println!("24-megapixel TIFF of 16 bits");
    print_ratio("  on the clock", costs.map(|cost| cost.clock), "the bare decoder");
    print_ratio("  processor time", costs.map(|cost| cost.processor), "the bare decoder");
}

/// Bytes, by a line of the system's account of this process.
fn memory(name: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'));
    line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok()).unwrap_or_default() * 1024
}

const BALL: Circle = Circle::new(600.0, 600.0, 564.0);

/// A ball that covers a million pixels, its card beside it.
fn ball() -> Photo {
    let pixel = |x: u32, y: u32| {
        let rho = BALL.rho(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let noise = 0.01 * (value(x, y, 7) - 0.5);
        let shown = |cosine: f64| [0.6, 0.5, 0.4].map(|r| hoffman(r, r + 0.15, CosTheta::new(cosine)));
        let metal = if rho < 1.0 { shown((1.0 - rho * rho).sqrt()) } else { [0.3; 3] };
        if x > 1180 { [0.9; 3] } else { metal.map(|f| (f + noise) as f32) }
    };
    let pixels = (0..1200_u32).into_par_iter().flat_map_iter(|y| (0..1250).map(move |x| pixel(x, y))).collect();
    Photo::from_linear("ball", 1250, 1200, pixels)
}

fn request() -> MatchRequest {
    let card = "1190,100,50,200@0.9".parse().expect("a card");
    MatchRequest { circle: Some(BALL), cards: vec![card], ..MatchRequest::default() }
}

/// The plain loop: the normal equations of r and h over every pixel that is fitted, by the textbook.
fn plain_loop(pixels: &[(f32, [f32; 3])]) -> [f64; 3] {
    let mut sums = [[0.0; 5]; 3];
    for (cosine, reflectance) in pixels {
        let Weights { of_r: a, of_h: b, of_white } = Weights::at(CosTheta::new(f64::from(*cosine)));
        for (sums, f) in sums.iter_mut().zip(reflectance) {
            let y = f64::from(*f) - of_white;
            for (sum, term) in sums.iter_mut().zip([a * a, a * b, b * b, a * y, b * y]) {
                *sum += term;
            }
        }
    }
    sums.map(|[aa, ab, bb, ay, by]| (ay * bb - by * ab) / (aa * bb - ab * ab))
}

/// The pixels of the ball that a match fits: up to 40° and from 55° to 83°, as cosine and value.
fn fitted(photo: &Photo) -> Vec<(f32, [f32; 3])> {
    let place = |i: u32| (f64::from(i % 1250) + 0.5, f64::from(i / 1250) + 0.5);
    let angle_deg = |i: u32| BALL.angle_deg(place(i).0, place(i).1);
    let is_fitted = |deg: f64| deg < 40.0 || (55.0..83.0).contains(&deg);
    let pixel = |i: u32| {
        let cosine = angle_deg(i).filter(|deg| is_fitted(*deg))?.to_radians().cos();
        Some((cosine as f32, photo.pixel(i % 1250, i / 1250)?.rgb.0.map(|v| v as f32)))
    };
    (0..1250 * 1200_u32).filter_map(pixel).collect()
}

/// Processor times of two things in turns.
fn processor_times<A, B>(ours: impl FnMut() -> A, bare: impl FnMut() -> B) -> [Duration; 2] {
    against(ours, bare).map(|cost| cost.processor)
}

/// The fits of a match to what was read, for a million pixels each: the bars are 2 ms by least squares, 10 ms robustly.
/// Then reading it, and a whole match of this ball.
fn fit_ratios() {
    let (photo, request) = (ball(), request());
    let fitted = fitted(&photo);
    let pixels = MatchPixels::read(&photo, &request).expect("a ball");
    println!("a ball of 1 megapixel: {} pixels are fitted, {} by the plain loop", pixels.count(), fitted.len());
    let for_a_million = |[ours, bare]: [Duration; 2]| {
        [ours.mul_f64(1e6 / pixels.count() as f64), bare.mul_f64(1e6 / fitted.len() as f64)]
    };
    let plain_loop = || plain_loop(black_box(&fitted));
    let print = |what: &str, costs: [Cost; 2]| {
        print_ratio(what, for_a_million(costs.map(|cost| cost.processor)), "a plain loop");
        println!("  on the clock {:.1?}", for_a_million(costs.map(|cost| cost.clock))[0]);
    };
    print("least squares of a million pixels", against(|| pixels.least_squares(), plain_loop));
    print("robust fit of a million pixels", against(|| pixels.robust_fit(), plain_loop));
    let read = || MatchPixels::read(&photo, &request).map(|pixels| pixels.count());
    print_ratio("reading the ball", processor_times(read, plain_loop), "a plain loop over what is fitted of it");
    let whole = || solve(&photo, &request, RgbSpace::LinRec709).expect("a match").r[0];
    let times = processor_times(whole, plain_loop);
    print_ratio("a match with outline, uncertainty and warnings", times, "a plain loop over what is fitted of it");
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn jpeg_of_24_megapixels(bencher: Bencher) {
    bencher.bench_local(|| ours("photo.jpg", jpeg()));
}

#[divan::bench]
fn preview_of_a_linear_picture(bencher: Bencher) {
    let photo = ball();
    bencher.bench_local(|| photo.preview(512));
}

#[divan::bench]
fn statistics_of_a_megapixel(bencher: Bencher) {
    let photo = ball();
    bencher.bench_local(|| AreaStatistics::of(&photo, Area::rectangle(100.0, 100.0, 1000.0, 1000.0)));
}

#[divan::bench(sample_count = 20)]
fn outline_that_is_snapped(bencher: Bencher) {
    let photo = ball();
    bencher.bench_local(|| snap_circle(&photo, Circle::new(610.0, 590.0, 540.0)));
}

#[divan::bench(sample_count = 20)]
fn ball_that_is_found(bencher: Bencher) {
    let photo = ball();
    bencher.bench_local(|| find_ball(&photo));
}

#[divan::bench(sample_count = 20)]
fn match_of_a_megapixel(bencher: Bencher) {
    let (photo, request) = (ball(), request());
    bencher.bench_local(|| solve(&photo, &request, RgbSpace::LinRec709));
}

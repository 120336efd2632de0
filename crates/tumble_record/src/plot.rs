//! Plots: curves over time as SVG.
//!
//! A white page, a light grid, units on the axes, a legend beside the curves when there are several. Long curves are
//! thinned without losing a peak; where a value is not finite, the curve has a gap.

use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{DashedPathElement, PathElement, Text};
use plotters::series::{DashedLineSeries, LineSeries};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoTextStyle, RGBColor, ShapeStyle, TextStyle, WHITE};

use crate::channel::{Channel, ChannelError, Series, WorldQuantity, world_series};
use crate::dim::RecordDim;
use crate::recording::Recording;
use crate::thin::keep_extremes;

/// What is drawn: curves, and the words around them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// What the vertical axis shows, with its unit.
    pub value_label: String,
    /// The curves, each with its label for the legend.
    pub series: Vec<Series>,
    /// How they are drawn.
    pub strokes: Strokes,
}

/// How curves are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strokes {
    /// All solid.
    #[default]
    Solid,
    /// Each with dashes of its own, so that of curves that coincide each shows through the gaps of those above it.
    Dashed,
    /// Families of neighbours that share a colour and its dashes. Within a family curves get finer and darker from the first to the last, and
    /// finer ones are drawn over broader ones.
    Families {
        /// Curves of each family, at least 1 and told apart up to [`MOST_BREADTHS`] [1].
        size: usize,
    },
}

/// Most curves of a family in a plot; more breadths could not be told apart.
pub const MOST_BREADTHS: usize = 4;

impl Strokes {
    /// Curves of a family; a curve by itself is a family of one.
    fn family_size(self) -> usize {
        match self {
            Self::Solid | Self::Dashed => 1,
            Self::Families { size } => size.max(1),
        }
    }

    /// Family of a curve.
    fn family(self, index: usize) -> usize {
        index / self.family_size()
    }

    /// Finer curves that follow in the family of a curve.
    fn finer(self, index: usize) -> usize {
        self.family_size() - 1 - index % self.family_size()
    }

    /// Lengths of a dash and of the gap after it for one of the curves [px]; none where it is solid.
    fn dashes(self, index: usize) -> Option<(u32, u32)> {
        if self == Self::Solid { None } else { DASHES[self.family(index) % DASHES.len()] }
    }

    /// Colour and width of a curve.
    fn style(self, index: usize) -> ShapeStyle {
        let finer = self.finer(index) as u32;
        let color = COLORS[self.family(index) % COLORS.len()];
        // What is broad is pale, so that a finer line on it is seen.
        let opacity = if finer == 0 { 1.0 } else { 0.4 };
        color.mix(opacity).stroke_width(fine(CURVE_WIDTH + BREADTH * finer))
    }

    /// The curves in the order in which they are drawn.
    fn drawn(self, count: usize) -> impl Iterator<Item = usize> {
        let broadest_first = (0..self.family_size()).rev();
        broadest_first.flat_map(move |finer| (0..count).filter(move |&index| self.finer(index) == finer))
    }
}

/// Dashes of the curves in turn: the later, the less of the earlier ones do they hide [px].
const DASHES: [Option<(u32, u32)>; 12] = [
    None,
    Some((16, 12)),
    Some((8, 10)),
    Some((3, 8)),
    Some((20, 20)),
    Some((6, 14)),
    Some((12, 20)),
    Some((3, 14)),
    Some((16, 26)),
    Some((8, 20)),
    Some((5, 18)),
    Some((3, 20)),
];
/// Length of dashed curves beyond which dashes would only fill the file; they are solid then [px].
const LONGEST_DASHED: f64 = 20_000.0;
/// Width of the finest curve of a family [px].
const CURVE_WIDTH: u32 = 2;
/// By how much the next broader curve of a family is wider [px].
const BREADTH: u32 = 4;
/// Length of the piece of a curve in the legend [px].
const LEGEND_PIECE: i32 = 52;
/// Size of the picture [px].
const SIZE: (u32, u32) = (960, 540);
/// Drawing units per pixel: the backend rounds to whole units, and curves of whole pixels would look jagged.
const FINE: u32 = 8;
/// Colours that people of every colour vision can tell apart (Okabe and Ito 2008), then darker ones for long lists.
const COLORS: [RGBColor; 12] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(127, 127, 0),
    RGBColor(0, 70, 110),
    RGBColor(160, 30, 60),
];
/// Most letters of a label in the legend.
const LABEL_LETTERS: usize = 32;
const INK: RGBColor = RGBColor(40, 44, 52);
const FAINT_INK: RGBColor = RGBColor(110, 116, 126);
const GRID: RGBColor = RGBColor(226, 229, 234);
const FONT: &str = "system-ui, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif";

type Page<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type DrawResult = Result<(), DrawingAreaErrorKind<std::io::Error>>;

impl Plot {
    /// Shows kinetic, potential and total energy over time: `energy.svg`.
    pub fn energy<D: RecordDim>(recording: &Recording<D>) -> Self {
        let curves = [
            (WorldQuantity::Kinetic, "kinetic"),
            (WorldQuantity::Potential, "potential"),
            (WorldQuantity::Total, "total"),
        ];
        let series =
            curves.map(|(quantity, label)| Series { label: label.to_owned(), ..world_series(recording, quantity) });
        Self {
            title: heading(recording, "energy"),
            value_label: "energy [J]".to_owned(),
            series: series.into(),
            ..Self::default()
        }
    }

    /// Shows a channel over time.
    pub fn channel<D: RecordDim>(recording: &Recording<D>, channel: &Channel) -> Result<Self, ChannelError> {
        let value_label = match channel.unit() {
            "1" => channel.name().replace('_', " "),
            unit => format!("{} [{unit}]", channel.name().replace('_', " ")),
        };
        let title = heading(recording, &channel.title());
        Ok(Self { title, value_label, series: channel.series(recording)?, ..Self::default() })
    }

    /// Draws the plot as the text of an SVG file.
    pub fn to_svg(&self) -> String {
        let mut svg = String::new();
        let fine_size = (SIZE.0 * FINE, SIZE.1 * FINE);
        let drawn = self.draw(SVGBackend::with_string(&mut svg, fine_size).into_drawing_area());
        drawn.expect("drawing into memory cannot fail");
        // The view box stays in fine units, the picture is shown in pixels.
        let shown = |size: (u32, u32)| format!("<svg width=\"{}\" height=\"{}\"", size.0, size.1);
        svg.replacen(&shown(fine_size), &shown(SIZE), 1)
    }

    fn draw(&self, page: Page<'_>) -> DrawResult {
        page.fill(&WHITE)?;
        page.draw(&Text::new(
            clean(&self.title, 90),
            point(74, 16),
            (FONT, fine(21)).into_text_style(&page).color(&INK),
        ))?;

        let legend_width = if self.series.len() > 1 { self.legend_width() } else { 0 };
        let (page, legend) = page.split_horizontally(fine(SIZE.0 - legend_width));
        let times = padded(span(self.series.iter().flat_map(|series| &series.times)), 0.0);
        let values = padded(span(self.series.iter().flat_map(|series| &series.values)), 0.06);
        let mut chart = ChartBuilder::on(&page)
            .margin_top(fine(54))
            .margin_right(fine(26))
            .margin_bottom(fine(12))
            .margin_left(fine(12))
            .x_label_area_size(fine(46))
            .y_label_area_size(fine(62))
            .build_cartesian_2d(times.0..times.1, values.0..values.1)?;
        self.draw_axes(&mut chart, times, values)?;
        for index in self.strokes.drawn(self.series.len()) {
            let style = self.strokes.style(index);
            for stretch in finite_stretches(&self.series[index]) {
                // A lone point has no line; a short dash keeps it visible.
                let width = if stretch.len() == 1 { (times.1 - times.0) * 0.004 } else { 0.0 };
                let dash = stretch.last().map(|&(time, value)| (time + width, value)).filter(|_| width > 0.0);
                let points: Vec<(f64, f64)> = stretch.into_iter().chain(dash).collect();
                match self.strokes.dashes(index).filter(|_| drawn_length(&chart, &points) < LONGEST_DASHED) {
                    Some((dash, gap)) => {
                        chart.draw_series(DashedLineSeries::new(points, fine(dash), fine(gap), style))?;
                    }
                    None => {
                        chart.draw_series(LineSeries::new(points, style))?;
                    }
                }
            }
        }
        if legend_width > 0 {
            self.draw_legend(&legend)?;
        }
        legend.present()
    }

    fn draw_axes(&self, chart: &mut Chart<'_>, times: (f64, f64), values: (f64, f64)) -> DrawResult {
        let ink: TextStyle<'_> = (FONT, fine(16)).into_text_style(chart.plotting_area()).color(&INK);
        let faint_ink: TextStyle<'_> = (FONT, fine(15)).into_text_style(chart.plotting_area()).color(&FAINT_INK);
        chart
            .configure_mesh()
            .x_labels(10)
            .y_labels(8)
            .x_label_formatter(&|time| tick(*time, times))
            .y_label_formatter(&|value| tick(*value, values))
            .x_desc("time [s]")
            .y_desc(clean(&self.value_label, 60))
            .label_style(faint_ink)
            .axis_desc_style(ink)
            .bold_line_style(ShapeStyle::from(&GRID).stroke_width(fine(1)))
            .light_line_style(WHITE.mix(0.0))
            .axis_style(ShapeStyle::from(&FAINT_INK).stroke_width(fine(1)))
            .set_all_tick_mark_size(fine(5))
            .draw()?;
        if values.0 < 0.0 && values.1 > 0.0 {
            let zero = PathElement::new(
                vec![(times.0, 0.0), (times.1, 0.0)],
                ShapeStyle::from(&FAINT_INK.mix(0.7)).stroke_width(fine(1)),
            );
            chart.draw_series([zero])?;
        }
        Ok(())
    }

    /// Returns the width of the legend, from the longest label; letters of this font are about 7 to 8 px wide.
    fn legend_width(&self) -> u32 {
        let longest =
            self.series.iter().map(|series| clean(&series.label, LABEL_LETTERS).chars().count()).max().unwrap_or(0);
        LEGEND_PIECE as u32 + 20 + 8 * longest as u32 + 12
    }

    fn draw_legend(&self, legend: &Page<'_>) -> DrawResult {
        let text: TextStyle<'_> =
            (FONT, fine(15)).into_text_style(legend).color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
        for (index, series) in self.series.iter().enumerate() {
            let y = 66 + 24 * index as i32;
            let piece = [point(6, y), point(6 + LEGEND_PIECE, y)];
            let style = self.strokes.style(index);
            let thick = style.stroke_width(style.stroke_width + fine(1));
            match self.strokes.dashes(index) {
                Some((dash, gap)) => legend.draw(&DashedPathElement::new(piece, fine(dash), fine(gap), thick))?,
                None => legend.draw(&PathElement::new(piece, thick))?,
            }
            let label = point(14 + LEGEND_PIECE, y);
            legend.draw(&Text::new(clean(&series.label, LABEL_LETTERS), label, text.clone()))?;
        }
        Ok(())
    }
}

/// Length of a curve in the picture [px].
fn drawn_length(chart: &Chart<'_>, points: &[(f64, f64)]) -> f64 {
    let places = points.iter().map(|point| chart.backend_coord(point));
    let steps = places.clone().zip(places.skip(1));
    let length = |from: i32, to: i32| (f64::from(to) - f64::from(from)).abs();
    steps.map(|(from, to)| length(from.0, to.0) + length(from.1, to.1)).sum::<f64>() / f64::from(FINE)
}

/// Converts a length from pixels to drawing units.
fn fine(pixels: u32) -> u32 {
    pixels * FINE
}

/// Converts a point from pixels to drawing units.
fn point(x: i32, y: i32) -> (i32, i32) {
    (x * FINE as i32, y * FINE as i32)
}

/// Returns the heading of a plot: scene, quantity and contact model.
fn heading<D: RecordDim>(recording: &Recording<D>, quantity: &str) -> String {
    let parts = [recording.scene.as_str(), quantity, recording.contact.as_str()];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("  ·  ")
}

/// Makes text fit for a drawing: no control characters, which SVG forbids, and at most so many letters.
fn clean(text: &str, most: usize) -> String {
    let letters = text.chars().map(|letter| if letter.is_control() { ' ' } else { letter });
    let mut clean: String = letters.take(most).collect();
    if text.chars().nth(most).is_some() {
        clean.push('…');
    }
    clean
}

/// Returns the least and the greatest finite number.
fn span<'a>(numbers: impl Iterator<Item = &'a f64>) -> Option<(f64, f64)> {
    numbers.filter(|number| number.is_finite()).fold(None, |span, &number| {
        Some(span.map_or((number, number), |(low, high): (f64, f64)| (low.min(number), high.max(number))))
    })
}

/// Widens a span by a share on both sides; a constant or an empty one gets a width it can be drawn with.
fn padded(span: Option<(f64, f64)>, share: f64) -> (f64, f64) {
    // Halves keep the widest spans finite.
    let (low, high) = span.map_or((0.0, 1.0), |(low, high)| (low.max(f64::MIN / 4.0), high.min(f64::MAX / 4.0)));
    let width = high - low;
    let rounding = 1e-9 * low.abs().max(high.abs());
    if width > rounding {
        (low - share * width, high + share * width)
    } else {
        let half = if low == 0.0 && high == 0.0 { 1.0 } else { 0.1 * low.abs().max(high.abs()) };
        (low - half, high + half)
    }
}

/// Writes the number at a tick with the digits that the span of the axis asks for.
fn tick(value: f64, (low, high): (f64, f64)) -> String {
    let step = (high - low) / 10.0;
    // Ticks at a rounding error from zero are zero.
    let value = if value.abs() < 1e-6 * step { 0.0 } else { value };
    let largest = low.abs().max(high.abs());
    if !(1e-4..1e6).contains(&largest) && value != 0.0 {
        return format!("{value:.3e}").replacen(".000e", "e", 1);
    }
    let decimals = (1.0 - step.log10()).ceil().clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

/// Splits a curve where it is not finite, and thins it to what the picture can show.
fn finite_stretches(series: &Series) -> Vec<Vec<(f64, f64)>> {
    let count = series.times.len().min(series.values.len());
    let kept = keep_extremes(count, SIZE.0 as usize, &[&series.values[..count]]);
    let points: Vec<(f64, f64)> = kept.into_iter().map(|index| (series.times[index], series.values[index])).collect();
    let stretches = points.split(|(time, value)| !(time.is_finite() && value.is_finite()));
    stretches.filter(|stretch| !stretch.is_empty()).map(<[_]>::to_vec).collect()
}

//! Plots as SVG: readable on light and on dark, in colours that most colour-blind people tell apart, and by their marks.
use std::fmt::Write as _;
use std::path::Path;

/// Okabe & Ito's palette, a middle lightness of it.
const COLORS: [&str; 4] = ["#0a84d6", "#e0761a", "#12a07a", "#c45fa0"];
const STYLE: &str = "text{font:13px system-ui,sans-serif;fill:#333}.title{font-size:15px;font-weight:600}\
    .grid{stroke:#8884;stroke-width:1}.frame{fill:none;stroke:#888}\
    @media(prefers-color-scheme:dark){text{fill:#ddd}}";
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 200.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 55.0;

#[derive(Clone, Copy)]
pub enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
}

pub struct Series {
    name: String,
    color: &'static str,
    mark: Mark,
    points: Vec<(f64, f64)>,
    line: Option<&'static str>,
}

impl Series {
    pub fn marks(name: &str, color: usize, mark: Mark, points: Vec<(f64, f64)>) -> Series {
        Series { name: name.into(), color: COLORS[color % COLORS.len()], mark, points, line: None }
    }

    pub fn line(name: &str, color: usize, mark: Mark, points: Vec<(f64, f64)>) -> Series {
        Series { line: Some("none"), ..Series::marks(name, color, mark, points) }
    }

    pub fn dashed(self) -> Series {
        Series { line: Some("6 4"), ..self }
    }
}

#[derive(Clone, Copy)]
enum Scale {
    Linear,
    Log,
}

pub struct Chart {
    series: Vec<Series>,
    x_scale: Scale,
    title: String,
    x_label: String,
    y_label: String,
}

impl Chart {
    /// Both axes by powers of ten.
    pub fn log_log(series: Vec<Series>) -> Chart {
        Chart {
            series,
            x_scale: Scale::Log,
            title: String::new(),
            x_label: String::new(),
            y_label: String::new(),
        }
    }

    /// The vertical axis by powers of ten.
    pub fn linear_log(series: Vec<Series>) -> Chart {
        Chart { x_scale: Scale::Linear, ..Chart::log_log(series) }
    }

    pub fn titled(self, title: &str, x_label: &str, y_label: &str) -> Chart {
        Chart { title: title.into(), x_label: x_label.into(), y_label: y_label.into(), ..self }
    }

    pub fn write(&self, path: &Path) {
        std::fs::write(path, self.svg()).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    }

    fn svg(&self) -> String {
        let coordinates = |pick: fn(&(f64, f64)) -> f64| self.series.iter().flat_map(|s| &s.points).map(pick);
        let x = Axis::around(self.x_scale, coordinates(|p| p.0), LEFT, WIDTH - RIGHT);
        let y = Axis::around(Scale::Log, coordinates(|p| p.1), HEIGHT - BOTTOM, TOP);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\">\n\
             <title>{}</title>\n<style>{STYLE}</style>\n",
            self.title
        );
        self.draw_frame(&mut svg, &x, &y);
        for (row, series) in self.series.iter().enumerate() {
            series.draw(&mut svg, &x, &y);
            let (left, line) = (WIDTH - RIGHT + 20.0, TOP + 12.0 + 22.0 * row as f64);
            series.draw_mark(&mut svg, left, line);
            text(&mut svg, left + 12.0, line + 4.0, "start", &series.name);
        }
        svg + "</svg>\n"
    }

    fn draw_frame(&self, svg: &mut String, x: &Axis, y: &Axis) {
        for (tick, label) in x.ticks() {
            let at = x.place(tick);
            line(svg, [at, TOP], [at, HEIGHT - BOTTOM]);
            text(svg, at, HEIGHT - BOTTOM + 18.0, "middle", &label);
        }
        for (tick, label) in y.ticks() {
            let at = y.place(tick);
            line(svg, [LEFT, at], [WIDTH - RIGHT, at]);
            text(svg, LEFT - 8.0, at + 4.0, "end", &label);
        }
        let (middle_x, middle_y) = ((LEFT + WIDTH - RIGHT) / 2.0, (TOP + HEIGHT - BOTTOM) / 2.0);
        let _ = writeln!(
            svg,
            "<rect class=\"frame\" x=\"{LEFT}\" y=\"{TOP}\" width=\"{}\" height=\"{}\"/>\n\
             <text class=\"title\" x=\"{LEFT}\" y=\"24\">{}</text>\n\
             <text transform=\"translate(18 {middle_y}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            WIDTH - RIGHT - LEFT,
            HEIGHT - BOTTOM - TOP,
            self.title,
            self.y_label
        );
        text(svg, middle_x, HEIGHT - 12.0, "middle", &self.x_label);
    }
}

fn line(svg: &mut String, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
    let _ = writeln!(svg, "<path class=\"grid\" d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\"/>");
}

fn text(svg: &mut String, x: f64, y: f64, anchor: &str, text: &str) {
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
}

impl Series {
    fn draw(&self, svg: &mut String, x: &Axis, y: &Axis) {
        // What cannot be drawn on an axis of powers, an error of 0, is left out.
        let shown = self.points.iter().filter(|p| p.1 > 0.0).map(|p| (x.place(p.0), y.place(p.1)));
        if let Some(dashes) = self.line {
            let path: Vec<String> = shown.clone().map(|(x, y)| format!("{x:.1} {y:.1}")).collect();
            let _ = writeln!(
                svg,
                "<path d=\"M{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-dasharray=\"{dashes}\"/>",
                path.join("L"),
                self.color
            );
        }
        shown.for_each(|(x, y)| self.draw_mark(svg, x, y));
    }

    fn draw_mark(&self, svg: &mut String, x: f64, y: f64) {
        let outline = match self.mark {
            Mark::Circle => {
                let _ =
                    writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{}\"/>", self.color);
                return;
            }
            Mark::Square => "m-4 -4h8v8h-8z",
            Mark::Triangle => "m0 -5l5 9h-10z",
            Mark::Diamond => "m0 -5l5 5l-5 5l-5 -5z",
        };
        let _ = writeln!(svg, "<path d=\"M{x:.1} {y:.1}{outline}\" fill=\"{}\"/>", self.color);
    }
}

/// Numbers along one side of a plot, in pixels from `start` to `end`.
struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    start: f64,
    end: f64,
}

impl Axis {
    /// An axis that takes in all `values`, out to whole powers of ten or whole numbers.
    fn around(scale: Scale, values: impl Iterator<Item = f64> + Clone, start: f64, end: f64) -> Axis {
        let values = values.filter(|v| matches!(scale, Scale::Linear) || *v > 0.0).map(|v| scaled(scale, v));
        let low = values.clone().fold(f64::INFINITY, f64::min).min(1e9);
        let high = values.fold(f64::NEG_INFINITY, f64::max).max(low);
        let low = low.floor();
        Axis { scale, low, high: (high - 1e-9).ceil().max(low + 1.0), start, end }
    }

    fn place(&self, value: f64) -> f64 {
        let share = (scaled(self.scale, value) - self.low) / (self.high - self.low);
        self.start + share * (self.end - self.start)
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        (self.low as i32..=self.high as i32)
            .map(|k| match self.scale {
                Scale::Linear => (f64::from(k), k.to_string()),
                Scale::Log => (10f64.powi(k), power_of_ten(k)),
            })
            .collect()
    }
}

fn scaled(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear => value,
        Scale::Log => value.log10(),
    }
}

/// 10 to the power of k, with the exponent raised.
fn power_of_ten(k: i32) -> String {
    if (-1..=1).contains(&k) {
        return ["0.1", "1", "10"][(k + 1) as usize].into();
    }
    let raised = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).expect("a raised digit"),
    };
    format!("10{}", k.to_string().chars().map(raised).collect::<String>())
}

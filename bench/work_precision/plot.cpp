#include "bench/work_precision/plot.hpp"

#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace slideway::bench {
namespace {

constexpr double width = 860, height = 520;
constexpr double left = 82, right = 610, top = 46, bottom = 462;  // of the frame

/// Distinguishable with colour-blind eyes (Okabe & Ito 2008); the marks tell them apart in grey.
constexpr std::string_view colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                        "#56b4e9", "#000000", "#8a6d00", "#7a3fa0", "#888888"};
enum class Mark { circle, square, diamond, up, down, left, right, count };

struct Axis {
    int first, last;  // decades
    double from, to;  // pixels
    double at(double value) const { return from + (to - from) * (std::log10(value) - first) / (last - first); }
};

struct Style {
    std::string_view colour;
    Mark mark;
    bool filled;
};

struct Curve {
    std::string name;
    Style style;
    std::vector<Row> rows;
};

bool drawable(double value) { return std::isfinite(value) && value > 0; }

std::string xml(std::string_view text) {
    std::string out;
    for (char const c : text) {
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return out;
}

/// The same colour and mark for one method whatever runs it; scalar code has hollow marks.
std::vector<Curve> curves_of(std::vector<Row> const& rows, std::vector<Method> const& methods) {
    std::vector<std::string> names;
    for (auto const& method : methods) {
        if (std::ranges::find(names, method.name) == names.end()) names.push_back(method.name);
    }
    std::vector<Curve> curves;
    for (auto const& row : rows) {
        auto const name = row.ours ? row.method + ", " + row.code : row.method;
        if (curves.empty() || curves.back().name != name) {
            auto const i = static_cast<std::size_t>(std::ranges::find(names, row.method) - names.begin());
            bool const hollow = row.ours && row.code == "scalar";
            auto const mark = static_cast<Mark>(i % static_cast<std::size_t>(Mark::count));
            curves.push_back({name, {colours[i % std::size(colours)], mark, !hollow}, {}});
        }
        curves.back().rows.push_back(row);
    }
    return curves;
}

template <class Value> Axis axis_over(std::vector<Row> const& rows, double from, double to, Value const& values) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (auto const& row : rows) {
        for (double const v : values(row)) {
            if (!drawable(v)) continue;
            low = std::min(low, v);
            high = std::max(high, v);
        }
    }
    if (high == 0) low = high = 1;
    int const first = static_cast<int>(std::floor(std::log10(low)));
    return {first, std::max(static_cast<int>(std::ceil(std::log10(high))), first + 1), from, to};
}

void draw_mark(fmt::ostream& out, double x, double y, Style const& style) {
    auto const paint = fmt::format("fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"",
                                   style.filled ? style.colour : "#ffffff", style.colour);
    auto const polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
        std::string points;
        for (auto const& [dx, dy] : corners) points += fmt::format("{:.1f},{:.1f} ", x + dx, y + dy);
        out.print("<polygon points=\"{}\" {}/>\n", points, paint);
    };
    switch (style.mark) {
        case Mark::circle:
            out.print("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" {}/>\n", x, y, paint);
            break;
        case Mark::square:
            polygon({{-3.5, -3.5}, {3.5, -3.5}, {3.5, 3.5}, {-3.5, 3.5}});
            break;
        case Mark::diamond:
            polygon({{0, -5}, {5, 0}, {0, 5}, {-5, 0}});
            break;
        case Mark::up:
            polygon({{0, -5}, {4.5, 3.5}, {-4.5, 3.5}});
            break;
        case Mark::down:
            polygon({{0, 5}, {4.5, -3.5}, {-4.5, -3.5}});
            break;
        case Mark::left:
            polygon({{-5, 0}, {3.5, -4.5}, {3.5, 4.5}});
            break;
        case Mark::right:
            polygon({{5, 0}, {-3.5, -4.5}, {-3.5, 4.5}});
            break;
        case Mark::count:
            break;
    }
}

template <class Error>
void draw_line(fmt::ostream& out, Curve const& curve, Axis const& x, Axis const& y, Error const& error,
               std::string_view stroke) {
    std::string points;
    for (auto const& row : curve.rows) {
        if (drawable(error(row))) points += fmt::format("{:.1f},{:.1f} ", x.at(row.seconds), y.at(error(row)));
    }
    out.print("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" {}/>\n", points, curve.style.colour, stroke);
}

/// Times read best in the unit that people would say.
std::string time_label(int decade) {
    static constexpr std::string_view units[] = {"ns", "µs", "ms", "s"};
    if (decade < -9 || decade > 2) return fmt::format("1e{} s", decade);
    int const thousands = (decade + 9) / 3;
    return fmt::format("{} {}", static_cast<int>(std::lround(std::pow(10.0, decade + 9 - 3 * thousands))),
                       units[thousands]);
}

void draw_frame(fmt::ostream& out, Axis const& x, Axis const& y, Problem const& problem) {
    auto const line = [&](double x1, double y1, double x2, double y2, std::string_view colour) {
        out.print("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2, y2,
                  colour);
    };
    for (int d = x.first; d <= x.last; ++d) {
        double const at = x.at(std::pow(10.0, d));
        line(at, top, at, bottom, "#dddddd");
        out.print("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", at, bottom + 18, time_label(d));
        for (int i = 2; d < x.last && i < 10; ++i) {
            double const minor = x.at(i * std::pow(10.0, d));
            line(minor, bottom, minor, bottom - 4, "#888888");
        }
    }
    int const stride = (y.last - y.first) > 12 ? 2 : 1;
    for (int d = y.first; d <= y.last; ++d) {
        double const at = y.at(std::pow(10.0, d));
        line(left, at, right, at, "#dddddd");
        if ((d - y.first) % stride != 0) continue;
        out.print(
            "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">10<tspan dy=\"-5\" font-size=\"9\">{}</tspan></text>\n",
            left - 8, at + 4, d);
    }
    out.print("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333333\"/>\n", left, top,
              right - left, bottom - top);
    double const middle = (left + right) / 2;
    out.print("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-size=\"15\">{}</text>\n", middle, top - 18,
              xml(problem.title));
    out.print("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">time per member, one core</text>\n", middle, bottom + 42);
    out.print("<text x=\"22\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 22 {0})\">{1}</text>\n",
              (top + bottom) / 2,
              problem.measure == Measure::energy    ? "energy residual |ε| [J]"
              : problem.measure == Measure::extrema ? "largest error of the extrema"
                                                    : "error of the state, relative to its scales");
}

void draw_legend(fmt::ostream& out, std::vector<Curve> const& curves) {
    double y = top + 10;
    double const x = right + 18;
    for (auto const& curve : curves) {
        out.print("<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke=\"{3}\" stroke-width=\"2\"/>\n", x, y,
                  x + 28, curve.style.colour);
        draw_mark(out, x + 14, y, curve.style);
        out.print("<text x=\"{}\" y=\"{}\">{}</text>\n", x + 36, y + 4, xml(curve.name));
        y += 20;
    }
    y += 10;
    for (auto const& [name, stroke] : {std::pair{"95th percentile", "stroke-width=\"2\""},
                                       std::pair{"median", "stroke-width=\"1.2\" stroke-dasharray=\"3 3\""}}) {
        out.print("<line x1=\"{0}\" y1=\"{1}\" x2=\"{2}\" y2=\"{1}\" stroke=\"#555555\" {3}/>\n", x, y, x + 28, stroke);
        out.print("<text x=\"{}\" y=\"{}\">{} of members</text>\n", x + 36, y + 4, name);
        y += 20;
    }
}

}  // namespace

void write_plot(std::filesystem::path const& file, Problem const& problem, std::vector<Row> const& rows,
                std::vector<Method> const& methods) {
    auto const curves = curves_of(rows, methods);
    auto const x = axis_over(rows, left, right, [](Row const& r) { return std::vector{r.seconds}; });
    auto const y = axis_over(rows, bottom, top, [](Row const& r) { return std::vector{r.median_error, r.p95_error}; });
    auto out = fmt::output_file(file.string());
    out.print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n",
        width, height);
    out.print("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
    draw_frame(out, x, y, problem);
    for (auto const& curve : curves) {
        draw_line(
            out, curve, x, y, [](Row const& r) { return r.median_error; },
            "stroke-width=\"1.2\" stroke-dasharray=\"3 3\"");
        draw_line(
            out, curve, x, y, [](Row const& r) { return r.p95_error; }, "stroke-width=\"2\"");
        for (auto const& row : curve.rows) {
            if (drawable(row.p95_error)) draw_mark(out, x.at(row.seconds), y.at(row.p95_error), curve.style);
        }
    }
    draw_legend(out, curves);
    out.print("</svg>\n");
}

}  // namespace slideway::bench

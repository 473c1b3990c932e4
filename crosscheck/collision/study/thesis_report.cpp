#include "crosscheck/collision/study/thesis_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/report/gnuplot.hpp"
#include "crosscheck/report/statistics.hpp"

namespace lockstep {
namespace {

constexpr std::array<std::size_t, 4> published_counts{50'000, 100'000, 150'000, 200'000};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The thesis's milliseconds. Its octree was run at a density "like B" alone.
struct Published {
    std::string_view scene;
    std::array<double, 4> cdt, octree;
};
constexpr std::array published{
    Published{"bunny_a", {12, 27, 52, 65}, {}},
    Published{"bunny_b", {13, 31, 50, 70}, {100, 195, 284, 413}},
    Published{"dragon_a", {12, 34, 54, 81}, {}},
    Published{"dragon_b", {14, 34, 56, 83}, {104, 194, 284, 370}},
};
constexpr double published_average = 46.75;         ///< ms, as its text has it
constexpr double published_abstract_average = 71.0; ///< ms, as its English abstract has it

/// How rows are called.
std::string title(std::string_view scene) {
    if (scene == "x_streams")
        return "x-streams";
    const std::size_t end = scene.size() - 2;
    return fmt::format("{:<7}{}", scene.substr(0, end), scene.back() == 'a' ? 'A' : 'B');
}

enum class ParticleSystem { cdt, octree, depth };

/// What was measured of it; null: nothing.
const SystemTimes* times_of(ParticleSystem system, const ThesisCell& cell) {
    if (system == ParticleSystem::cdt)
        return &cell.cdt;
    const std::optional<SystemTimes>& times = system == ParticleSystem::octree ? cell.octree : cell.depth;
    return times ? &*times : nullptr;
}

/// The thesis's ms for a scene and count; NaN where it gives none.
double published_ms(ParticleSystem system, std::string_view scene, std::size_t count) {
    if (system == ParticleSystem::depth)
        return not_a_number;
    for (const Published& row : published)
        for (std::size_t c = 0; c < published_counts.size(); ++c)
            if (row.scene == scene && published_counts[c] == count) {
                const double ms = system == ParticleSystem::cdt ? row.cdt[c] : row.octree[c];
                return ms > 0.0 ? ms : not_a_number;
            }
    return not_a_number;
}

double measured_ms(ParticleSystem system, const ThesisCell& cell) {
    const SystemTimes* times = times_of(system, cell);
    return times == nullptr ? not_a_number : 1e3 * times->wall;
}

/// What the particles add to a frame with one alone; NaN where that was not measured.
double added_ms(ParticleSystem system, const ThesisCell& cell) {
    const SystemTimes* times = times_of(system, cell);
    return times != nullptr && times->fixed > 0.0 ? 1e3 * (times->wall - times->fixed) : not_a_number;
}

std::vector<std::size_t> counts_of_scene(const ThesisRun& run, std::string_view scene) {
    std::vector<std::size_t> counts;
    for (const ThesisCell& cell : run.cells)
        if (cell.scene == scene)
            counts.push_back(cell.particles);
    return counts;
}

std::vector<std::size_t> counts(const ThesisRun& run) {
    return run.cells.empty() ? std::vector<std::size_t>{} : counts_of_scene(run, run.cells.front().scene);
}

/// None where the scene was left out.
const ThesisCell* find_cell(const ThesisRun& run, std::string_view scene, std::size_t particles) {
    const auto found = std::find_if(run.cells.begin(), run.cells.end(), [&](const ThesisCell& cell) {
        return cell.scene == scene && cell.particles == particles;
    });
    return found == run.cells.end() ? nullptr : &*found;
}

/// Exponent of time over count; NaN where it cannot be told.
double exponent(std::span<const std::size_t> counts, std::span<const double> ms) {
    const bool known = std::all_of(ms.begin(), ms.end(), [](double v) { return v > 0.0; });
    return counts.size() > 1 && known ? fitted_exponent(counts, ms) : not_a_number;
}

/// How far times are from growing along a straight line; NaN where it cannot be told.
double off_line(std::span<const std::size_t> counts, std::span<const double> ms) {
    return std::isnan(exponent(counts, ms)) ? not_a_number : deviation_from_line(counts, ms);
}

std::string digits_text(double value, int digits = 2) {
    return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
}

/// As many digits as a short or a long time needs.
std::string ms_text(double ms) { return digits_text(ms, ms < 100.0 ? 2 : 0); }

/// A name, and one right-aligned text a column.
std::string line(std::string_view name, const std::vector<std::string>& columns, std::size_t width = 9) {
    std::string text = fmt::format("{:<11}", name);
    for (const std::string& column : columns)
        text += fmt::format(" {:>{}}", column, width);
    return text + "\n";
}

/// The columns of times_row; with_exponents false: of ratio_row.
std::string head(const std::vector<std::size_t>& counts, bool with_published, bool with_exponents = true) {
    std::vector<std::string> columns;
    const auto add_counts = [&] {
        for (const std::size_t count : counts)
            columns.push_back(fmt::format("{}", count));
        if (with_exponents)
            columns.emplace_back("exponent");
    };
    add_counts();
    if (with_published) {
        columns.emplace_back("thesis");
        add_counts();
    }
    return line("", columns);
}

/// Measured times with their exponent, then the thesis's.
std::string times_row(std::string_view name, const std::vector<std::size_t>& counts, const std::vector<double>& ms,
                      const std::vector<double>& thesis) {
    std::vector<std::string> columns;
    for (const double value : ms)
        columns.push_back(ms_text(value));
    columns.push_back(digits_text(exponent(counts, ms)));
    if (!thesis.empty()) {
        columns.emplace_back("");
        for (const double value : thesis)
            columns.push_back(ms_text(value));
        columns.push_back(digits_text(exponent(counts, thesis)));
    }
    return line(name, columns);
}

struct Series {
    std::vector<double> ms, added, thesis;
};

Series series(const ThesisRun& run, ParticleSystem system, std::string_view scene) {
    Series s;
    for (const std::size_t count : counts(run)) {
        const ThesisCell* cell = find_cell(run, scene, count);
        s.ms.push_back(cell != nullptr ? measured_ms(system, *cell) : not_a_number);
        s.added.push_back(cell != nullptr ? added_ms(system, *cell) : not_a_number);
        s.thesis.push_back(published_ms(system, scene, count));
    }
    return s;
}

/// Figure 5-3: bunny and dragon at density B, averaged.
Series average_of_b(const ThesisRun& run, ParticleSystem system) {
    Series mean = series(run, system, "bunny_b");
    const Series other = series(run, system, "dragon_b");
    for (std::size_t i = 0; i < mean.ms.size(); ++i) {
        mean.ms[i] = 0.5 * (mean.ms[i] + other.ms[i]);
        mean.thesis[i] = 0.5 * (mean.thesis[i] + other.thesis[i]);
    }
    return mean;
}

std::vector<double> quotient(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> q;
    for (std::size_t i = 0; i < a.size(); ++i)
        q.push_back(a[i] / b[i]);
    return q;
}

std::string ratio_row(std::string_view name, const std::vector<double>& ratios, const std::vector<double>& thesis) {
    std::vector<std::string> columns;
    for (const double ratio : ratios)
        columns.push_back(digits_text(ratio, 1));
    if (!thesis.empty())
        columns.emplace_back("");
    for (const double ratio : thesis)
        columns.push_back(digits_text(ratio, 1));
    return line(name, columns);
}

std::string percents(double part) { return digits_text(100.0 * part, 1); }

/// Least and greatest of what is a number.
std::string range(const std::vector<double>& values, int digits) {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (const double value : values)
        if (!std::isnan(value)) {
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        }
    return least > greatest ? "-" : fmt::format("{} to {}", digits_text(least, digits), digits_text(greatest, digits));
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of all cells of table 4-1, as the thesis printed them.
double published_mean() {
    std::vector<double> cells;
    for (const Published& row : published)
        cells.insert(cells.end(), row.cdt.begin(), row.cdt.end());
    return mean(cells);
}

/// Our averages beside the thesis's, each beside what it is the average of.
std::string averages(const ThesisRun& run) {
    std::vector<double> ms, particles;
    for (const ThesisCell& cell : run.cells)
        if (cell.scene != "x_streams") {
            ms.push_back(measured_ms(ParticleSystem::cdt, cell));
            particles.push_back(static_cast<double>(cell.particles));
        }
    return fmt::format(
        "CDT, average of table 4-1: {} ms at {} particles ({} cells; the thesis's 16 cells, at 125000 "
        "particles, average {:.2f} ms)\n"
        "CDT, average of dragon B: {} ms (thesis {:.2f} ms, which its text calls the average of all)\n"
        "the thesis's English abstract says {:.0f} ms, which is the average of no row and no column of table 4-1\n",
        ms_text(mean(ms)), digits_text(mean(particles), 0), ms.size(), published_mean(),
        ms_text(mean(series(run, ParticleSystem::cdt, "dragon_b").ms)), published_average, published_abstract_average);
}

/// A text of each system, one after the other; the depth's where it was measured.
template <class Text> std::string each_system(const ThesisRun& run, const Text& text) {
    std::string all = fmt::format("{} (CDT), {} (octree)", text(ParticleSystem::cdt), text(ParticleSystem::octree));
    const bool depth =
        std::any_of(run.cells.begin(), run.cells.end(), [](const ThesisCell& cell) { return cell.depth.has_value(); });
    return depth ? fmt::format("{}, {} (depth)", all, text(ParticleSystem::depth)) : all;
}

std::string findings(const ThesisRun& run) {
    const std::vector<std::size_t> n = counts(run);
    /// Least and greatest over the scenes.
    const auto over_scenes = [&](ParticleSystem system, auto&& value, int digits) {
        std::vector<double> values;
        for (const std::string_view scene : thesis_scenes)
            values.push_back(value(series(run, system, scene)));
        return range(values, digits);
    };
    const std::string grows = each_system(run, [&](ParticleSystem system) {
        return over_scenes(
            system, [&](const Series& s) { return exponent(n, s.ms); }, 2);
    });
    const std::string added = each_system(run, [&](ParticleSystem system) {
        return over_scenes(
            system, [&](const Series& s) { return exponent(n, s.added); }, 2);
    });
    const std::string off = each_system(run, [&](ParticleSystem system) {
        return over_scenes(
                   system, [&](const Series& s) { return 100.0 * off_line(n, s.ms); }, 1) +
               " %";
    });
    std::vector<double> octree, depth;
    bool slower = true;
    for (const ThesisCell& cell : run.cells) {
        octree.push_back(cell.octree_ratio().value_or(not_a_number));
        depth.push_back(cell.depth_ratio().value_or(not_a_number));
        slower = slower && octree.back() > 1.0;
    }
    return averages(run) + fmt::format("time ~ particles^x: x {}; 0.9 to 1.1 is linear\n"
                                       "the same of what particles add to a frame with one alone: x {}\n"
                                       "off the line a + b * particles: {} at most\n"
                                       "octree / CDT: {} (thesis 4.5 to 7.7); octree slower in every cell: {}\n"
                                       "depth / CDT: {}\n",
                                       grows, added, off, range(octree, 1), slower ? "yes" : "no", range(depth, 2));
}

struct Column {
    std::string_view name;
    double (*value)(const ThesisCell&);
};

double value_of(ParticleSystem system, const ThesisCell& cell, double (*value)(const SystemTimes&)) {
    const SystemTimes* times = times_of(system, cell);
    return times != nullptr ? value(*times) : not_a_number;
}

constexpr auto gpu_ms = [](const SystemTimes& times) { return times.gpu > 0.0 ? 1e3 * times.gpu : not_a_number; };
constexpr auto wall_ms = [](const SystemTimes& times) { return 1e3 * times.wall; };
constexpr auto recall = [](const SystemTimes& times) { return times.recall; };
constexpr auto answers = [](const SystemTimes& times) { return times.answers; };

using enum ParticleSystem;

/// What a cell's line of CSV holds after scene and particles.
constexpr std::array csv_columns{
    Column{"cdt_ms", [](const ThesisCell& c) { return value_of(cdt, c, wall_ms); }},
    Column{"cdt_gpu_ms", [](const ThesisCell& c) { return value_of(cdt, c, gpu_ms); }},
    Column{"cdt_recall", [](const ThesisCell& c) { return value_of(cdt, c, recall); }},
    Column{"octree_ms", [](const ThesisCell& c) { return value_of(octree, c, wall_ms); }},
    Column{"octree_gpu_ms", [](const ThesisCell& c) { return value_of(octree, c, gpu_ms); }},
    Column{"octree_recall", [](const ThesisCell& c) { return value_of(octree, c, recall); }},
    Column{"octree_over_cdt", [](const ThesisCell& c) { return c.octree_ratio().value_or(not_a_number); }},
    Column{"thesis_cdt_ms", [](const ThesisCell& c) { return published_ms(cdt, c.scene, c.particles); }},
    Column{"thesis_octree_ms", [](const ThesisCell& c) { return published_ms(octree, c.scene, c.particles); }},
    Column{"depth_ms", [](const ThesisCell& c) { return value_of(depth, c, wall_ms); }},
    Column{"depth_gpu_ms", [](const ThesisCell& c) { return value_of(depth, c, gpu_ms); }},
    Column{"depth_over_cdt", [](const ThesisCell& c) { return c.depth_ratio().value_or(not_a_number); }},
    Column{"cdt_answers", [](const ThesisCell& c) { return value_of(cdt, c, answers); }},
    Column{"octree_answers", [](const ThesisCell& c) { return value_of(octree, c, answers); }},
    Column{"depth_answers", [](const ThesisCell& c) { return value_of(depth, c, answers); }},
};

nlohmann::json system_json(const SystemTimes& times) {
    nlohmann::json json{{"frames", times.frames}, {"seconds", times.wall}, {"gpu_seconds", times.gpu}};
    if (times.fixed > 0.0)
        json["fixed_seconds"] = times.fixed;
    if (!std::isnan(times.recall))
        json["recall"] = times.recall;
    if (!std::isnan(times.answers))
        json["answers"] = times.answers;
    return json;
}

SystemTimes read_system(const JsonValue& json) {
    constexpr NumberRule seconds{0.0, 1e9, "a time in seconds"};
    constexpr NumberRule share{0.0, 1.0, "a share from 0 to 1"};
    json.check_keys({"frames", "seconds", "gpu_seconds", "fixed_seconds", "recall", "answers"});
    SystemTimes times;
    times.frames = static_cast<int>(json.at("frames").integer(1, 100'000'000));
    times.wall = json.at("seconds").number(seconds);
    times.gpu = json.at("gpu_seconds").number(seconds);
    if (const auto fixed = json.find("fixed_seconds"))
        times.fixed = fixed->number(seconds);
    const auto share_of = [&](const char* name) {
        const auto found = json.find(name);
        return found ? found->number(share) : not_a_number;
    };
    times.recall = share_of("recall");
    times.answers = share_of("answers");
    return times;
}

/// A block of data: count, then each series; a missing value is NaN, which gnuplot leaves out.
std::string data_block(std::string_view name, const std::vector<std::size_t>& counts,
                       const std::vector<std::vector<double>>& series) {
    std::string text = fmt::format("${} << EOD\n", name);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        text += fmt::format("{}", counts[i]);
        for (const std::vector<double>& values : series)
            text += std::isnan(values[i]) ? " NaN" : fmt::format(" {:.6g}", values[i]);
        text += '\n';
    }
    return text + "EOD\n";
}

std::string panel(std::string_view name, std::string_view title, const std::vector<std::string>& lines) {
    std::string text = fmt::format("set title {}\nplot ", gnuplot_quoted(title));
    for (std::size_t i = 0; i < lines.size(); ++i)
        text += fmt::format("{}${} using 1:{} with linespoints lw 2 lc {} title {}", i == 0 ? "" : ", ", name, i + 2,
                            i + 1, gnuplot_quoted(lines[i]));
    return text + "\n";
}

} // namespace

std::string thesis_cell_head() {
    const std::string system =
        fmt::format(" {:>9} {:>9} {:>6} {:>8} {:>9}", "ms", "GPU clock", "frames", "recall %", "answers %");
    return fmt::format("{:<9} {:>9} {:^45} {:^45} {:^45}\n{:<9} {:>9}{}{}{} {:>10} {:>10}\n", "", "", "CDT", "octree",
                       "depth", "scene", "particles", system, system, system, "octree/CDT", "depth/CDT");
}

std::string thesis_cell_text(const ThesisCell& cell) {
    const auto system = [&](ParticleSystem which) {
        const auto text = [&](double (*value)(const SystemTimes&)) { return value_of(which, cell, value); };
        const SystemTimes* times = times_of(which, cell);
        return fmt::format(" {:>9} {:>9} {:>6} {:>8} {:>9}", ms_text(text(wall_ms)), ms_text(text(gpu_ms)),
                           times != nullptr ? fmt::format("{}", times->frames) : "-", percents(text(recall)),
                           percents(text(answers)));
    };
    return fmt::format("{:<9} {:>9}{}{}{} {:>10} {:>10}\n", cell.scene, cell.particles, system(cdt), system(octree),
                       system(depth), digits_text(cell.octree_ratio().value_or(not_a_number), 1),
                       digits_text(cell.depth_ratio().value_or(not_a_number)));
}

std::string thesis_text(const ThesisRun& run) {
    const std::vector<std::size_t> n = counts(run);
    std::string out = fmt::format("GL {}\nms a frame, mean, until GL has finished; thesis: RTX 2060\n", run.context);
    const auto table = [&](ParticleSystem system) {
        for (const std::string_view scene : thesis_scenes)
            if (scene != "x_streams") {
                const Series s = series(run, system, scene);
                out += times_row(title(scene), n, s.ms, s.thesis);
            }
    };
    out += "\nTable 4-1, CDT\n" + head(n, true);
    table(cdt);
    out += "\nTable 5-1, octree of depth 3\n" + head(n, true);
    table(octree);

    const Series cdt_of_b = average_of_b(run, cdt);
    const Series octree_of_b = average_of_b(run, octree);
    out += "\nFigure 5-3, bunny and dragon at density B, averaged\n" + head(n, true);
    out +=
        times_row("CDT", n, cdt_of_b.ms, cdt_of_b.thesis) + times_row("octree", n, octree_of_b.ms, octree_of_b.thesis);
    out += "\nFigure 5-5, streams along x\n" + head(n, false);
    out += times_row("CDT", n, series(run, cdt, "x_streams").ms, {});
    out += times_row("octree", n, series(run, octree, "x_streams").ms, {});

    out += "\nOctree / CDT\n" + head(n, true, false);
    for (const std::string_view scene : thesis_scenes) {
        const Series a = series(run, octree, scene);
        const Series b = series(run, cdt, scene);
        out += ratio_row(title(scene), quotient(a.ms, b.ms), quotient(a.thesis, b.thesis));
    }
    out += "\nDepth of the scene\n" + head(n, false);
    for (const std::string_view scene : thesis_scenes)
        out += times_row(title(scene), n, series(run, depth, scene).ms, {});
    out += "\nDepth / CDT\n" + head(n, false, false);
    for (const std::string_view scene : thesis_scenes)
        out += ratio_row(title(scene), quotient(series(run, depth, scene).ms, series(run, cdt, scene).ms), {});
    const auto shares = [&](double (*value)(const SystemTimes&)) {
        for (const std::string_view scene : thesis_scenes) {
            std::vector<std::string> columns;
            for (const std::size_t count : n) {
                const ThesisCell* cell = find_cell(run, scene, count);
                const auto share = [&](ParticleSystem system) {
                    return percents(cell != nullptr ? value_of(system, *cell, value) : not_a_number);
                };
                columns.push_back(fmt::format("{} / {} / {}", share(cdt), share(octree), share(depth)));
            }
            out += line(title(scene), columns, 19);
        }
    };
    out += "\nRecall %, CDT / octree / depth: of the particles with another in range, those that find one\n";
    shares(recall);
    out += "\nAnswers %, CDT / octree / depth: of the particles that touch an obstacle, those that find it, or a "
           "particle\n";
    shares(answers);
    return out + "\n" + findings(run);
}

std::string thesis_csv(const ThesisRun& run) {
    std::string out = "scene,particles";
    for (const Column& column : csv_columns)
        out += fmt::format(",{}", column.name);
    out += '\n';
    for (const ThesisCell& cell : run.cells) {
        out += fmt::format("{},{}", cell.scene, cell.particles);
        for (const Column& column : csv_columns) {
            const double value = column.value(cell);
            out += std::isnan(value) ? "," : fmt::format(",{:.6g}", value);
        }
        out += '\n';
    }
    return out;
}

nlohmann::json thesis_json(const ThesisRun& run) {
    nlohmann::json cells = nlohmann::json::array();
    for (const ThesisCell& cell : run.cells) {
        cells.push_back({{"scene", cell.scene}, {"particles", cell.particles}, {"cdt", system_json(cell.cdt)}});
        if (cell.octree)
            cells.back()["octree"] = system_json(*cell.octree);
        if (cell.depth)
            cells.back()["depth"] = system_json(*cell.depth);
    }
    return {{"context", run.context}, {"cells", cells}};
}

ThesisRun read_thesis_json(const std::filesystem::path& file) {
    const nlohmann::json document = read_json(file);
    const JsonValue json(document, file.string());
    json.check_keys({"context", "cells"});
    ThesisRun run;
    run.context = json.at("context").text();
    for (const JsonValue& item : json.at("cells").items()) {
        item.check_keys({"scene", "particles", "cdt", "octree", "depth"});
        ThesisCell cell;
        cell.scene = thesis_scenes[item.at("scene").choice(thesis_scenes)];
        cell.particles = static_cast<std::size_t>(item.at("particles").integer(1, 100'000'000));
        cell.cdt = read_system(item.at("cdt"));
        if (const auto octree = item.find("octree"))
            cell.octree = read_system(*octree);
        if (const auto depth = item.find("depth"))
            cell.depth = read_system(*depth);
        run.cells.push_back(cell);
    }
    if (run.cells.empty())
        json.at("cells").fail("no cells; a run has one at least");
    for (const ThesisCell& cell : run.cells)
        if (counts_of_scene(run, cell.scene) != counts(run))
            json.at("cells").fail(
                fmt::format("scene {} has other particle counts than {}", cell.scene, run.cells.front().scene));
    return run;
}

std::string thesis_chart(const ThesisRun& run) {
    const std::vector<std::size_t> n = counts(run);
    const auto ms = [&](ParticleSystem system, std::string_view scene) { return series(run, system, scene).ms; };
    std::vector<std::vector<double>> table_4_1, table_5_1;
    std::vector<std::string> names;
    for (const std::string_view scene : thesis_scenes)
        if (scene != "x_streams") {
            table_4_1.push_back(ms(ParticleSystem::cdt, scene));
            table_5_1.push_back(ms(ParticleSystem::octree, scene));
            names.push_back(title(scene));
        }
    const Series cdt = average_of_b(run, ParticleSystem::cdt);
    const Series octree = average_of_b(run, ParticleSystem::octree);
    return data_block("t41", n, table_4_1) + data_block("t51", n, table_5_1) +
           data_block("f53", n, {cdt.ms, octree.ms, cdt.thesis, octree.thesis}) +
           data_block("f55", n, {ms(ParticleSystem::cdt, "x_streams"), ms(ParticleSystem::octree, "x_streams")}) +
           fmt::format("set terminal svg size 1100,800 noenhanced background rgb 'white'\n"
                       "set multiplot layout 2,2 title {}\n"
                       "set xlabel 'particles'\nset ylabel 'ms a frame'\nset grid\nset key below\n"
                       "set xtics 50000\n",
                       gnuplot_quoted(run.context)) +
           "set yrange [0:]\n" + panel("t41", "Table 4-1, CDT", names) +
           panel("t51", "Table 5-1, octree of depth 3", names) + "set logscale y\nset yrange [*:*]\n" +
           panel("f53", "Figure 5-3, average at density B", {"CDT", "octree", "CDT, thesis", "octree, thesis"}) +
           panel("f55", "Figure 5-5, streams along x", {"CDT", "octree"}) + "unset multiplot\n";
}

} // namespace lockstep

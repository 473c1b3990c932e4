#include "crosscheck/cli/part_file.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/json_text.hpp"
#include "crosscheck/files/sha256.hpp"
#include "crosscheck/report/part_json.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr int part_version = 3;
constexpr int most_width = 1 << 20;
constexpr const char* program = "lockstep " LOCKSTEP_VERSION;

json run_json(const CheckedRun& run) {
    return {
        {"name", run.name},         {"file", run.file},   {"context", run.context},          {"profile", run.profile},
        {"settings", run.settings}, {"notes", run.notes}, {"shaders", run.recorded_shaders}, {"width", run.width}};
}

CheckedRun read_run(const JsonValue& value) {
    value.check_keys({"name", "file", "context", "profile", "settings", "notes", "shaders", "width"});
    CheckedRun run;
    run.name = value.at("name").text();
    run.file = value.at("file").text();
    run.context = value.at("context").text();
    run.profile = value.at("profile").text();
    run.settings = value.at("settings").text();
    for (const JsonValue& note : value.at("notes").items())
        run.notes.push_back(note.text());
    run.recorded_shaders = value.at("shaders").text();
    run.width = static_cast<int>(value.at("width").integer(1, most_width));
    return run;
}

json request_json(const CheckRequest& request) {
    return {{"trace", request.trace.string()},
            {"legal", static_cast<int>(request.legal)},
            {"allow_undefined", request.rules.allow_undefined},
            {"require_hits", request.rules.require_hits},
            {"power_at_least", fmt::format("{}", request.rules.power_at_least)}};
}

bool truth(const JsonValue& value) {
    if (!value.is_truth())
        value.fail("is neither true nor false");
    return value.truth();
}

CheckRequest read_request(const JsonValue& value) {
    value.check_keys({"trace", "legal", "allow_undefined", "require_hits", "power_at_least"});
    CheckRequest request;
    request.trace = value.at("trace").text();
    request.legal = static_cast<Legal>(value.at("legal").integer(0, static_cast<int>(Legal::by_text)));
    request.rules.allow_undefined = truth(value.at("allow_undefined"));
    request.rules.require_hits = truth(value.at("require_hits"));
    const std::string share = value.at("power_at_least").text();
    if (const std::string problem = share_option("", request.rules.power_at_least, "").keep({&share, 1});
        !problem.empty())
        value.at("power_at_least").fail(problem);
    return request;
}

} // namespace

json part_file_json(const RunPart& part) {
    return {
        {"version", part_version},
        {"program", program},
        {"recording", {{"sha256", part.recording.sha256}, {"bytes", part.recording.bytes}, {"frames", part.recorded}}},
        {"of", part.of},
        {"request", request_json(part.request)},
        {"run", run_json(part.run)},
        {"report", part_json(part.report)}};
}

json stress_part_file_json(const StressReport& report) {
    return {{"version", part_version}, {"program", program}, {"stress", stress_part_json(report)}};
}

namespace {

std::string digest_of(json document) {
    document.at("part").erase("sha256");
    const std::string text = json_text(document);
    return sha256_of(std::as_bytes(std::span(text)));
}

} // namespace

std::string part_file_text(json report, json part) {
    report["part"] = std::move(part);
    report["part"]["sha256"] = digest_of(report);
    return json_text(report);
}

namespace {

RunPart read_run_part(const JsonValue& value, const std::string& file) {
    value.check_keys({"version", "program", "recording", "of", "request", "run", "report", "sha256"});
    RunPart part;
    part.file = file;
    const JsonValue recording = value.at("recording");
    recording.check_keys({"sha256", "bytes", "frames"});
    part.recording.sha256 = recording.at("sha256").label();
    part.recording.bytes = static_cast<std::uint64_t>(recording.at("bytes").integer(1, INT64_MAX));
    part.recorded = static_cast<int>(recording.at("frames").integer(1, most_frames));
    part.of = static_cast<int>(value.at("of").integer(1, part.recorded));
    part.request = read_request(value.at("request"));
    part.run = read_run(value.at("run"));
    part.report = read_part(value.at("report"), collision_schema());
    if (part.report.first >= part.of || part.report.frames > part.of - part.report.first)
        value.fail(fmt::format("has frames {} to {} of {}", part.report.first,
                               std::int64_t{part.report.first} + part.report.frames - 1, part.of));
    return part;
}

} // namespace

PartFile read_part_file(const std::filesystem::path& file) {
    if (file.extension() == ".xml")
        throw Error(fmt::format("{}: JUnit keeps a part's verdict, not what it found; right is the part's JSON, of "
                                "which merge --junit FILE makes the whole's JUnit",
                                file.string()));
    const json document = read_json(file);
    const JsonValue whole(document, file.string());
    if (!document.is_object() || !document.contains("part") || !document.at("part").is_object())
        throw Error(
            fmt::format("{}: holds no part of a run; right is what lockstep check --trace FILE --shard K/N --json "
                        "PART.json writes",
                        file.string()));
    const JsonValue value = whole.at("part");
    static_cast<void>(value.at("version").integer(part_version, part_version));
    if (const std::string by = value.at("program").label(); by != program)
        throw Error(
            fmt::format("{}: was written by '{}'; this is {}, and parts are joined by the program that made them",
                        file.string(), by, program));
    PartFile part{file.string(), {}, {}};
    if (const auto stress = value.find("stress")) {
        value.check_keys({"version", "program", "stress", "sha256"});
        part.stress = read_stress_part(*stress, document.at("part").at("stress"));
    } else {
        part.run = read_run_part(value, part.file);
    }
    if (value.at("sha256").label() != digest_of(document))
        throw Error(
            fmt::format("{}: was changed after lockstep wrote it; expected the part as it was written", part.file));
    return part;
}

} // namespace lockstep

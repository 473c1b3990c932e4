#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/cli/commands.hpp"
#include "crosscheck/cli/run_options.hpp"
#include "crosscheck/command/option_values.hpp"
#include "crosscheck/files/output_files.hpp"
#include "crosscheck/report/probe_table.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "gpu/probe.hpp"

namespace lockstep {
namespace {

struct ProbeRequest {
    RunOptions run;
    ProbeOptions probe;
    std::filesystem::path json;
};

int run(const ProbeRequest& options) {
    OutputFiles files;
    if (!options.json.empty())
        files.expect(options.json);
    const Context context(parse_context_request(options.run.gl));
    const ProbeResult result = probe(context, options.probe);
    const std::string profile = describe(profile_from(result));
    if (!options.json.empty()) {
        nlohmann::json json = result;
        json["profile"] = profile;
        files.write(options.json, json.dump(1) + "\n");
    }
    fmt::print("{}\nprofile {}\n", probe_table(result), profile);
    files.commit();
    return status_agree;
}

} // namespace

Verb probe_command() {
    auto options = std::make_shared<ProbeRequest>();
    Verb verb{"probe", "measure the arithmetic and the rasterisation of a GL driver"};
    verb.add(text_option("--gl", "auto|osmesa|egl|egl-device:N", options->run.gl, "which GL to open"));
    verb.add(path_option("--json", "FILE", options->json, "write the measurements as JSON"));
    verb.add(integer_option("--inputs", "N", {64, 1 << 22}, options->probe.inputs, "random inputs an arithmetic row"));
    verb.footer = "Exit status: 0 measured, 2 could not run.\n"
                  "Example: lockstep probe --gl egl-device:0 --json probe.json";
    verb.run = [options](const Call&) { return run(*options); };
    return verb;
}

} // namespace lockstep

#include "crosscheck/check_file/system.hpp"

#include <memory>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/check_file/bound_passes.hpp"
#include "crosscheck/check_file/document.hpp"
#include "crosscheck/check_file/start_values.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/text/text_pass.hpp"
#include "reference/model/error.hpp"

namespace lockstep::check_file {
namespace {

namespace fs = std::filesystem;

/// A folder that a key names, beside the file; the file's own where it is not there.
fs::path folder(const JsonValue& document, std::string_view key, const fs::path& file, const fs::path& otherwise) {
    const auto named = document.find(key);
    if (!named)
        return otherwise;
    fs::path found = file.parent_path() / named->text();
    if (named->text().empty() || !fs::is_directory(found))
        named->fail(fmt::format("{} is no folder; expected one beside the file", plain_line(found.string())));
    return found;
}

/// What `new check` guessed and nobody took out of its list.
std::string guesses_text(const JsonValue& scene) {
    const auto todo = scene.find("todo");
    const std::size_t left = todo ? todo->items().size() : 0;
    return left == 0 ? "" : fmt::format("{} guess{} in its list \"todo\"", left, left == 1 ? "" : "es");
}

} // namespace

SceneFolders folders_of(const JsonValue& document, const fs::path& file) {
    const fs::path here = file.has_parent_path() ? file.parent_path() : fs::path(".");
    SceneFolders made;
    made.shaders = folder(document, "shaders", file, here);
    made.reference = folder(document, "reference", file, made.shaders);
    return made;
}

SystemScene load(const JsonValue& scene, const std::string& name, const SceneOptions& options) {
    if (options.particles)
        throw Error("--particles: a check file has its counts in its state");
    if (options.preset)
        throw Error("--preset: a check file has no presets");
    if (!options.set.empty())
        throw Error("--set: a check file has no switches");
    const Document document = read_document(scene);
    BoundPasses bound = bound_passes(document, folders_of(scene, scene.file()).shaders);
    std::vector<Extent> extents;
    for (const StateEntry& entry : document.state)
        extents.push_back(entry.extent);
    SystemState start(*bound.schema, std::move(extents));
    for (std::size_t e = 0; e < document.state.size(); ++e)
        set_start(document.state[e], start[static_cast<std::uint8_t>(e)]);
    System system{.name = name,
                  .schema = *bound.schema,
                  .passes = passes_without_twins(bound.passes),
                  .mistakes = {},
                  .start = std::move(start),
                  .settings = guesses_text(scene),
                  .texts = {},
                  .keeps = bound.schema};
    return {.system = std::move(system), .passes = std::move(bound.passes)};
}

} // namespace lockstep::check_file

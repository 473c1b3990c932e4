#include "lockstep/check_file.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/check_file/system.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"
#include "crosscheck/package/own_texts.hpp"
#include "lockstep/system.hpp"

namespace lockstep {

MatchResult match_check_file(const Gl& gl, const std::string& file, const CheckFileOptions& options) {
    const nlohmann::json document = read_json(file);
    const JsonValue check(document, file);
    SceneFolders folders = check_file::folders_of(check, file);
    if (!options.shaders.empty())
        folders.shaders = options.shaders;
    if (!options.reference.empty())
        folders.reference = options.reference;
    SystemScene scene = check_file::load(check, plain_line(std::filesystem::path(file).stem().string()), {});
    GlSystemSide gpu(gl, scene.system, scene.passes, folders.shaders.string(), scene.arithmetic);
    SystemTexts texts(scene.system, scene.passes, scene.arithmetic);
    texts.take_references(folders.reference, folders.shaders, UnusedShaders::allowed);
    return match_system(gpu, scene.system,
                        {.frames = options.frames,
                         .mode = options.mode,
                         .legal = options.legal,
                         .allow_undefined = options.allow_undefined,
                         .repeat = options.repeat.empty()
                                       ? fmt::format("lockstep check {} --frames {}", shell_path(file), options.frames)
                                       : options.repeat,
                         .reference = folders.reference.string()});
}

} // namespace lockstep

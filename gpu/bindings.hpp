#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lockstep {

/// What a uniform of a shader from elsewhere gets: one of ours, a number of its own, or one of these a component.
struct UniformBinding {
    std::string path;                                           ///< in the file: "/uniforms/resolution"
    std::vector<std::variant<std::string, double>> values = {}; ///< names of ours, numbers
    bool is_list = false;
    bool transposed = false; ///< "transpose(u_ProjView)": the name's matrix with rows for columns
};

/// What a member of a storage block holds of each item: one value, or a list of them, one after the other.
struct MemberBinding {
    std::string path;                                           ///< in the file: "/storage_blocks/Particles/place"
    std::vector<std::variant<std::string, double>> values = {}; ///< "Before.speed", "count", or a number
    bool is_list = false;
};

/// What a storage block of a shader from elsewhere holds: all of one of ours, or a value for each of its members.
struct StorageBlockBinding {
    std::string path;                                               ///< in the file: "/storage_blocks/Particles"
    std::string ours;                                               ///< the block of ours; empty: by member
    std::map<std::string, MemberBinding, std::less<>> members = {}; ///< by the shader's names
};

/// The names of a shader from elsewhere beside ours (docs/own_shader.md).
struct Bindings {
    std::string file;
    /// By the shader's names, of a member of a uniform block "Frame.tick".
    std::map<std::string, UniformBinding, std::less<>> uniforms;
    std::map<std::string, std::string, std::less<>> attributes, outputs;    ///< ours by the shader's
    std::vector<std::string> blocks;                                        ///< uniform blocks that are bound by member
    std::map<std::string, StorageBlockBinding, std::less<>> storage_blocks; ///< by the shader's names

    [[nodiscard]] bool binds_block(std::string_view block) const;
    /// The shader's name of one of our outputs; the same where none is given.
    [[nodiscard]] std::string output(std::string_view ours) const;
};

inline constexpr std::string_view bindings_file = "bindings.json";

/// What the shaders beside the file consist of.
struct FolderNames {
    std::vector<std::string> words;
    std::vector<std::string> storage_blocks; ///< declared in them
};

/// What `text` says, the text of that file. Throws Error with FILE: and the JSON path for what is no such thing, and
/// for a name that no shader has.
std::shared_ptr<const Bindings> parse_bindings(const std::string& file, const std::string& text,
                                               const FolderNames& names);

} // namespace lockstep

#pragma once
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace lockstep {

/// An option or an argument as help tells of it.
struct OptionText {
    std::vector<std::string> names; ///< "-o", "--output"; of an argument its one name
    bool argument = false;          ///< given by its place
    std::string value;              ///< FILE, N, cpu|gpu; empty: a flag
    std::string description;

    /// The values there are, where there are few ("cpu|gpu"); placeholders in capitals are left out.
    [[nodiscard]] std::vector<std::string> choices() const;
};

struct VerbText {
    std::string name;
    std::string description;
    std::vector<OptionText> options;
    std::string footer; ///< exit status and example
};

/// What the program knows of its verbs, in their order.
std::vector<VerbText> verb_texts(const CLI::App& app);

} // namespace lockstep

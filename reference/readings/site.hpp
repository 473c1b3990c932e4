#pragma once
#include <cstdint>
#include <source_location>
#include <string_view>

namespace lockstep {

/// A place in a twin where something can be seen, told, left open or be wrong: a value, a decision, an operation. Its
/// name is its own and stays when lines move; two sites of one name are one site.
struct Site {
    std::string_view label;
    std::string_view output = {}; ///< the shader's output that tells of it: "trace_clip"
    std::string_view unit = {};   ///< of a decision's margin
    double per_unit = 1.0;        ///< a margin in `unit` is this times the difference of the operands

    [[nodiscard]] constexpr std::uint32_t id() const { return id_of(label); }

    /// FNV-1a.
    static constexpr std::uint32_t id_of(std::string_view name) {
        std::uint32_t id = 2166136261U;
        for (const char c : name)
            id = (id ^ static_cast<unsigned char>(c)) * 16777619U;
        return id;
    }
};

/// A site and the line of the twin that comes by it.
struct Place {
    const Site& site;
    std::source_location where;
    Place(const Site& site_, std::source_location where_ = std::source_location::current()) // NOLINT: a site is a place
        : site(site_), where(where_) {}
};

} // namespace lockstep

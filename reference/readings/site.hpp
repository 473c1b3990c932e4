#pragma once
#include <cstdint>
#include <source_location>
#include <string_view>

namespace lockstep {

/// FNV-1a.
constexpr std::uint32_t name_id(std::string_view name) {
    std::uint32_t id = 2166136261U;
    for (const char c : name)
        id = (id ^ static_cast<unsigned char>(c)) * 16777619U;
    return id;
}

/// A place in a twin where something can be seen, told, left open or be wrong: a value, a decision, an operation. Its
/// label is its own and stays when lines move; two sites of one label are one site.
struct Site {
    std::string_view label;
    std::string_view output; ///< the shader's output that tells of it: "trace_clip"; may be empty
    std::string_view unit;   ///< of a decision's margin
    double per_unit;         ///< a margin in `unit` is this times the difference of the operands
    std::uint32_t id, output_id;

    consteval Site(std::string_view label_, std::string_view output_ = {}, std::string_view unit_ = {},
                   double per_unit_ = 1.0)
        : label(label_), output(output_), unit(unit_), per_unit(per_unit_), id(name_id(label_)),
          output_id(output_.empty() ? 0 : name_id(output_)) {}

    /// A site that is known at run time alone, as the line of a text. The label outlives it.
    static Site named(std::string_view label) {
        constexpr Site unnamed("");
        Site site = unnamed;
        site.label = label;
        site.id = name_id(label);
        return site;
    }
};

/// A site and the line of the twin that comes by it.
struct At {
    const Site& site;
    std::source_location where;
    At(const Site& site_, std::source_location where_ = std::source_location::current()) // NOLINT: a site is a place
        : site(site_), where(where_) {}
};

} // namespace lockstep

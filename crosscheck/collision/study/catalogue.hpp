#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// The thesis's failure catalogue (chapters 3.4 and 6), each effect as two numbers of one quantity: with what causes
/// the effect, and without. Every effect has a scene of its name.
struct CatalogueRow {
    std::string_view name;
    std::string_view figure; ///< of the thesis
    std::string_view quantity;
    std::string_view cause;
    double with_cause = 0.0;
    std::string_view control;
    double without_cause = 0.0;
    double times = 1.0; ///< the effect is there when with_cause > times * without_cause

    [[nodiscard]] bool holds() const { return with_cause > times * without_cause; }
};

/// The names, in the order of the spec.
std::span<const std::string_view> catalogue_names();

/// Measures one effect in `scenes`/NAME.json, by the reference. Throws Error for another name, and like load_scene.
std::vector<CatalogueRow> measure_catalogue(std::string_view name, const std::filesystem::path& scenes);

/// One line of a Markdown table, and its head.
std::string catalogue_head();
std::string catalogue_text(const CatalogueRow& row);

} // namespace lockstep

#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/judge/mistake_words.hpp"

/// What the lists of fluid's mistakes are written with.
namespace lockstep::fluid {

using Words = std::span<float>;
using Constants = std::array<float, 3>;

inline Mistake ranged_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::ranged_by_formula, .formula = formula};
}
inline Mistake decided_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::decided_by_formula, .formula = formula};
}
inline Mistake instead_of(const Site& site, const Site& source) {
    return mistake_at(site, Change::instead, -1, &source);
}

// Formulas of constants.

inline void as_given(Words value, const CameBy& run) {
    std::copy_n(run.constants.begin(), std::min(value.size(), run.constants.size()), value.begin());
}
inline void second_given(Words value, const CameBy& run) { value[0] = run.constants[1]; }
inline void scaled_by_given(Words value, const CameBy& run) { value[0] *= run.constants[0]; }

/// What a host hands over in place of the right value.
inline Mistake given(const Site& site, const Constants& wrong) { return spoiled_at(site, as_given, wrong); }
inline Mistake scaled(const Site& site, double by) {
    return formula_at(site, scaled_by_given, {static_cast<float>(by)});
}

/// Mistakes of one pass.
class Of {
  public:
    Of(std::vector<NamedMistake>& all, std::string pass) : all_(all), pass_(std::move(pass)) {}
    Of& add(const char* name, const char* meaning, const Mistake& mistake,
            const std::vector<Constants>& constants = {}) {
        all_.push_back({name, meaning, pass_, mistake, constants});
        return *this;
    }
    /// One that says what is seen, whatever the cause.
    Of& add_description(const char* name, const char* meaning, const Mistake& mistake) {
        add(name, meaning, mistake);
        all_.back().describes = true;
        return *this;
    }
    /// One that shaders write in ways that round otherwise.
    Of& add_free(const char* name, const char* meaning, const Mistake& mistake) {
        add(name, meaning, mistake);
        all_.back().freely_written = true;
        return *this;
    }

  private:
    std::vector<NamedMistake>& all_;
    std::string pass_;
};

} // namespace lockstep::fluid

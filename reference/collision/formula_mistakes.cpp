#include "reference/collision/formula_mistakes.hpp"

#include <vector>

#include "reference/collision/formulas/words.hpp"

namespace lockstep {

std::span<const FormulaMistake> formula_mistakes() {
    static const std::vector<FormulaMistake> all = [] {
        std::vector<FormulaMistake> made;
        formulas::add_windows(made);
        formulas::add_fetches(made);
        formulas::add_choices(made);
        formulas::add_base_texels(made);
        formulas::add_responses(made);
        formulas::add_fall(made);
        return made;
    }();
    return all;
}

} // namespace lockstep

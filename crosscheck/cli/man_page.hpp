#pragma once
#include <string>
#include <vector>

#include "crosscheck/cli/verb_texts.hpp"

namespace lockstep {

/// lockstep(1), for man: `summary` in a sentence, then the verbs.
std::string man_page(const std::string& summary, const std::vector<VerbText>& verbs);

} // namespace lockstep

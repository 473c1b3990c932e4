#pragma once
#include <string>
#include <vector>

#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// lockstep(1), for man: `summary` in a sentence, then the verbs.
std::string man_page(const std::string& summary, const std::vector<Verb>& verbs);

} // namespace lockstep

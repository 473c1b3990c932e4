#pragma once
#include <string>
#include <vector>

#include "crosscheck/command/verb.hpp"

namespace lockstep {

/// Scripts that complete verbs, options, and values where there are few; anything else as a file name. The zsh one is
/// bash's, through zsh's own bridge to it.
std::string bash_completion(const std::vector<Verb>& verbs);
std::string zsh_completion(const std::vector<Verb>& verbs);
std::string fish_completion(const std::vector<Verb>& verbs);

} // namespace lockstep

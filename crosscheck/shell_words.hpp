#pragma once
#include <string>
#include <string_view>

namespace lockstep {

/// `word` as a shell takes it back to one word: quoted where it must be.
std::string shell_word(std::string_view word);

} // namespace lockstep

#pragma once
#include <cstddef>
#include <string_view>

namespace lockstep {

/// Walks through a shader's text, comments left out: words (names and numbers), and other characters one by one. Takes
/// texts of any length and shape; std::regex recurses once a character.
class ShaderWords {
  public:
    explicit ShaderWords(std::string_view text) : text_(text) {}

    /// Goes on to the next one; false at the end, where token() is empty.
    bool next();
    [[nodiscard]] std::string_view token() const { return token_; }
    [[nodiscard]] std::size_t line() const { return line_; } ///< of token(), from 1

  private:
    void skip(std::size_t characters);

    std::string_view text_; ///< what comes after token_
    std::string_view token_;
    std::size_t line_ = 1;
};

/// Whether a word stands in a shader outside its comments.
bool says(std::string_view shader, std::string_view word);

} // namespace lockstep

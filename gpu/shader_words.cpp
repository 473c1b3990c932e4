#include "gpu/shader_words.hpp"

#include <algorithm>

namespace lockstep {
namespace {

bool in_word(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// The end of the comment that `text` begins with; 0: none.
std::size_t comment_length(std::string_view text) {
    const bool line = text.starts_with("//");
    if (!line && !text.starts_with("/*"))
        return 0;
    const std::size_t end = line ? text.find('\n') : text.find("*/", 2);
    return end == std::string_view::npos ? text.size() : end + (line ? 0 : 2);
}

} // namespace

void ShaderWords::skip(std::size_t characters) {
    line_ += static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + static_cast<long>(characters), '\n'));
    text_.remove_prefix(characters);
}

bool ShaderWords::next() {
    token_ = {};
    while (!text_.empty()) {
        if (const std::size_t comment = comment_length(text_); comment > 0) {
            skip(comment);
        } else if (is_blank(text_.front())) {
            skip(1);
        } else {
            const auto end = std::find_if_not(text_.begin(), text_.end(), in_word);
            token_ = text_.substr(0, std::max<std::size_t>(1, static_cast<std::size_t>(end - text_.begin())));
            text_.remove_prefix(token_.size());
            return true;
        }
    }
    return false;
}

bool says(std::string_view shader, std::string_view word) {
    ShaderWords words(shader);
    while (words.next())
        if (words.token() == word)
            return true;
    return false;
}

} // namespace lockstep

#include "gpu/shader_bounds.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "gpu/shader_source.hpp"
#include "gpu/shader_words.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr double most_words = 1U << 18U;             // that macros add
constexpr std::uint64_t most_elements = 1ULL << 26U; // of an array
constexpr int most_nested = 256;                     // macros in macros

struct Word {
    std::string_view text;
    std::size_t line = 0; ///< of the stage's text, from 1
};
using Words = std::span<const Word>;

/// How many words come of a text: so many, and of each argument's so many.
struct Size {
    double words = 0.0;
    std::vector<double> arguments = {};
    void add(double times, const Size& other) {
        words += times * other.words;
        for (std::size_t k = 0; k < arguments.size() && k < other.arguments.size(); ++k)
            arguments[k] += times * other.arguments[k];
    }
};

struct CountedMacro {
    bool takes_arguments = false;
    std::vector<std::string_view> parameters = {};
    std::vector<Word> body = {};
    std::optional<Size> size = {};
    bool is_open = false; ///< its size is being found: within itself it is not expanded
};

/// The macros of a text, and the words outside of directives. A line that ends with a backslash goes on in the next.
class Expansion {
  public:
    explicit Expansion(const ShaderSource& stage) : stage_(stage) {
        const std::string_view text = stage.text;
        std::size_t line = 1;
        for (std::size_t begin = 0; begin < text.size();) {
            std::size_t end = std::min(text.find('\n', begin), text.size()), lines = 1;
            for (; end < text.size() && end > begin && text[end - 1] == '\\'; ++lines)
                end = std::min(text.find('\n', end + 1), text.size());
            take_line(text.substr(begin, end - begin), line);
            begin = end + 1;
            line += lines;
        }
    }

    void check() {
        check_arrays(words_);
        for (const auto& [name, macro] : macros_)
            check_arrays(macro.body);
        double all = 0.0;
        for (std::size_t at = 0; at < words_.size();) {
            const std::size_t first = at;
            const Size size = size_of_one(words_, at, {}, 0);
            all += size.words - static_cast<double>(at - first);
            if (all > most_words)
                fail(words_[first], fmt::format("macros expand to more than {} words", most_words));
        }
    }

  private:
    [[noreturn]] void fail(const Word& at, const std::string& what) const {
        const ShaderSource::Origin origin =
            at.line <= stage_.origins.size() ? stage_.origins[at.line - 1] : ShaderSource::Origin{};
        throw Error(fmt::format("shader {}:{}: {}", stage_.files[origin.file], origin.line, what));
    }

    void take_line(std::string_view text, std::size_t line) {
        std::vector<Word> words;
        for (ShaderWords all(text); all.next();)
            if (all.token() != "\\")
                words.push_back({all.token(), line + all.line() - 1});
        if (words.empty() || words.front().text != "#") {
            words_.insert(words_.end(), words.begin(), words.end());
            return;
        }
        if (words.size() < 3 || words[1].text != "define")
            return;
        CountedMacro macro;
        std::size_t body = 3;
        const char* const behind = words[2].text.data() + words[2].text.size();
        if (macro.takes_arguments = words.size() > 3 && words[3].text == "(" && words[3].text.data() == behind;
            macro.takes_arguments)
            for (++body; body < words.size() && words[body - 1].text != ")"; ++body)
                if (words[body].text != "," && words[body].text != ")")
                    macro.parameters.push_back(words[body].text);
        macro.body.assign(words.begin() + static_cast<std::ptrdiff_t>(std::min(body, words.size())), words.end());
        macros_.emplace(words[2].text, std::move(macro));
    }

    void check_arrays(Words words) const {
        for (std::size_t k = 0; k + 2 < words.size(); ++k) {
            if (words[k].text != "[" || words[k + 2].text != "]")
                continue;
            std::string_view number = words[k + 1].text;
            if (const auto macro = macros_.find(number); macro != macros_.end() && macro->second.body.size() == 1)
                number = macro->second.body.front().text;
            std::uint64_t elements = 0;
            const auto status = std::from_chars(number.data(), number.data() + number.size(), elements).ec;
            if (status == std::errc::result_out_of_range || (status == std::errc{} && elements > most_elements))
                fail(words[k], fmt::format("[{}]: arrays of at most {} elements are compiled", number.substr(0, 40),
                                           most_elements));
        }
    }

    /// Of the largest definition of a name.
    const Size& size_of(CountedMacro& macro, int depth) {
        if (!macro.size) {
            macro.is_open = true;
            macro.size = size_of(macro.body, macro.parameters, depth + 1);
            macro.is_open = false;
        }
        return *macro.size;
    }

    Size size_of(Words words, std::span<const std::string_view> parameters, int depth) {
        Size all{0.0, std::vector<double>(parameters.size())};
        for (std::size_t at = 0; at < words.size();)
            all.add(1.0, size_of_one(words, at, parameters, depth));
        return all;
    }

    /// Of the word at `at`, with its arguments; `at` goes behind them.
    Size size_of_one(Words words, std::size_t& at, std::span<const std::string_view> parameters, int depth) {
        const Word& word = words[at++];
        Size size{1.0, std::vector<double>(parameters.size())};
        if (const auto of = std::ranges::find(parameters, word.text); of != parameters.end()) {
            size.words = 0.0;
            size.arguments[static_cast<std::size_t>(of - parameters.begin())] = 1.0;
            return size;
        }
        const auto [first, last] = macros_.equal_range(word.text);
        const bool has_arguments = at < words.size() && words[at].text == "(";
        if (first == last || (first->second.takes_arguments && !has_arguments) ||
            std::any_of(first, last, [](const auto& one) { return one.second.is_open; }))
            return size;
        if (depth > most_nested)
            fail(word, fmt::format("macros are nested deeper than {}", most_nested));
        std::vector<Size> arguments;
        if (first->second.takes_arguments)
            for (const Words one : arguments_at(words, at))
                arguments.push_back(size_of(one, parameters, depth + 1));
        size.words = 0.0;
        for (auto one = first; one != last; ++one) {
            Size here{0.0, std::vector<double>(parameters.size())};
            const Size& body = size_of(one->second, depth);
            here.words = body.words;
            for (std::size_t k = 0; k < arguments.size() && k < body.arguments.size(); ++k)
                here.add(body.arguments[k], arguments[k]);
            if (here.words >= size.words)
                size = std::move(here);
        }
        return size;
    }

    /// From the parenthesis at `at`, which goes behind its end.
    static std::vector<Words> arguments_at(Words words, std::size_t& at) {
        std::vector<Words> all;
        int depth = 0;
        for (std::size_t first = at + 1; at < words.size();) {
            const std::string_view text = words[at++].text;
            depth += text == "(" ? 1 : text == ")" ? -1 : 0;
            if (depth == 0 || (depth == 1 && text == ",")) {
                all.push_back(words.subspan(first, at - 1 - first));
                first = at;
            }
            if (depth == 0)
                break;
        }
        return all;
    }

    const ShaderSource& stage_;
    std::multimap<std::string_view, CountedMacro> macros_;
    std::vector<Word> words_;
};

} // namespace

void check_bounds(const ShaderSource& stage) { Expansion(stage).check(); }

} // namespace lockstep

#include "crosscheck/text/open_constants.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/text/program.hpp"

namespace lockstep {
namespace {

constexpr std::string_view through = text::counted_name;

/// The functions whose operands GLSL restricts.
constexpr auto restricted = std::to_array<std::string_view>(
    {"acos",           "acosh",     "asin",    "atan",        "atanh",     "bitfieldExtract",
     "bitfieldInsert", "clamp",     "inverse", "inversesqrt", "ldexp",     "log",
     "log2",           "max",       "min",     "mod",         "normalize", "pow",
     "sqrt",           "smoothstep"});
constexpr auto conversions =
    std::to_array<std::string_view>({"int", "ivec2", "ivec3", "ivec4", "uint", "uvec2", "uvec3", "uvec4"});
constexpr auto other_types = std::to_array<std::string_view>(
    {"float",  "vec2",   "vec3",   "vec4",   "bool",   "bvec2",  "bvec3",  "bvec4",  "mat2",   "mat3",  "mat4",
     "mat2x2", "mat2x3", "mat2x4", "mat3x2", "mat3x3", "mat3x4", "mat4x2", "mat4x3", "mat4x4", "double"});
/// Further functions that a compiler folds, each between spaces.
constexpr std::string_view folded =
    " abs all any ceil cos cosh cross degrees determinant distance dot equal exp exp2 "
    "faceforward floor fma fract greaterThan lessThan length matrixCompMult mix not notEqual "
    "outerProduct radians reflect round roundEven sign sin sinh step tan tanh transpose trunc "
    "isnan isinf floatBitsToInt floatBitsToUint intBitsToFloat uintBitsToFloat bitCount findLSB ";

template <class All> bool is_among(const All& all, std::string_view one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

bool is_folded(std::string_view function) {
    return folded.find(fmt::format(" {} ", function)) != std::string_view::npos;
}

struct Token {
    enum class Kind : std::uint8_t { word, number, other };
    std::string_view text;
    std::size_t begin = 0, line = 1;
    Kind kind = Kind::other;

    [[nodiscard]] std::size_t end() const { return begin + text.size(); }
    [[nodiscard]] bool is(std::string_view what) const { return text == what; }
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Directives, each a line, are left out.
std::vector<Token> tokens_of(std::string_view text) {
    constexpr auto signs =
        std::to_array<std::string_view>({"<<=", ">>=", "<<", ">>", "++", "--", "&&", "||", "^^", "==", "!=",
                                         "<=",  ">=",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="});
    std::vector<Token> all;
    bool is_line_begun = false;
    for (std::size_t at = 0, line = 1; at < text.size();) {
        const char c = text[at];
        if (c == '\n') {
            ++line, ++at, is_line_begun = false;
        } else if (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f') {
            ++at;
        } else if (c == '#' && !is_line_begun) {
            at = std::min(text.find('\n', at), text.size());
        } else {
            is_line_begun = true;
            std::size_t end = at + 1;
            const bool is_number = is_digit(c) || (c == '.' && end < text.size() && is_digit(text[end]));
            if (is_number || is_letter(c)) {
                const bool is_hexadecimal = text.substr(at, 2) == "0x" || text.substr(at, 2) == "0X";
                while (end < text.size() &&
                       (is_digit(text[end]) || is_letter(text[end]) || (is_number && text[end] == '.') ||
                        (is_number && !is_hexadecimal && (text[end] == '-' || text[end] == '+') &&
                         (text[end - 1] == 'e' || text[end - 1] == 'E'))))
                    ++end;
            } else {
                for (const std::string_view sign : signs)
                    if (text.substr(at, sign.size()) == sign) {
                        end = at + sign.size();
                        break;
                    }
            }
            all.push_back({text.substr(at, end - at), at, line,
                           is_number      ? Token::Kind::number
                           : is_letter(c) ? Token::Kind::word
                                          : Token::Kind::other});
            at = end;
        }
    }
    return all;
}

class Opener {
  public:
    Opener(const std::string& text, bool is_es, const std::set<std::size_t>& but)
        : text_(text), is_es_(is_es), but_(but), tokens_(tokens_of(text)) {}

    std::optional<std::string> opened() {
        if (tokens_.empty())
            return std::nullopt;
        partners();
        for (std::size_t i = 0; i < tokens_.size(); ++i)
            if (tokens_[i].is("const"))
                note_constants(i);
        for (std::size_t i = 0; i < tokens_.size(); ++i)
            i = take(i);
        if (into_.empty())
            return std::nullopt;
        std::string made = text_.substr(0, tokens_.front().begin) + functions();
        std::size_t from = tokens_.front().begin;
        std::stable_sort(into_.begin(), into_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [at, what] : into_) {
            made += text_.substr(from, at - from) + what;
            from = at;
        }
        return made + text_.substr(from);
    }

  private:
    using Insertions = std::vector<std::pair<std::size_t, std::string>>; ///< before a character

    static std::string functions() {
        std::string all;
        for (const std::string_view type : {"float", "vec2", "vec3", "vec4", "mat2", "mat3", "mat4", "int", "ivec2",
                                            "ivec3", "ivec4", "uint", "uvec2", "uvec3", "uvec4"})
            all += fmt::format("highp {0} {1}(const highp {0} x) {{ return x; }} ", type, through);
        return all;
    }
    [[nodiscard]] const Token& token(std::size_t i) const {
        static const Token none;
        return i < tokens_.size() ? tokens_[i] : none;
    }
    /// Of every bracket the other one.
    void partners() {
        partner_.assign(tokens_.size(), tokens_.size());
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (tokens_[i].is("(") || tokens_[i].is("[") || tokens_[i].is("{"))
                open.push_back(i);
            if ((tokens_[i].is(")") || tokens_[i].is("]") || tokens_[i].is("}")) && !open.empty()) {
                partner_[i] = open.back();
                partner_[open.back()] = i;
                open.pop_back();
            }
        }
    }
    /// The first token from `at` on that is one of `what`, outside of brackets that open behind `at`.
    [[nodiscard]] std::size_t next(std::size_t at, std::initializer_list<std::string_view> what) const {
        for (; at < tokens_.size(); ++at) {
            if (is_among(what, tokens_[at].text))
                return at;
            if (partner_[at] > at && partner_[at] < tokens_.size())
                at = partner_[at];
        }
        return at;
    }
    /// The declarators of a constant's declaration that begins at `at`: names, and where their values begin and end.
    struct Declared {
        std::size_t type = 0, end = 0; ///< end: the semicolon
        struct One {
            std::size_t name = 0, first = 0, last = 0; ///< last: behind the value
        };
        std::vector<One> all;
    };
    [[nodiscard]] Declared declared(std::size_t at) const {
        constexpr auto qualifiers = std::to_array<std::string_view>({"highp", "mediump", "lowp", "precise"});
        Declared made;
        std::size_t i = at + 1;
        while (is_among(qualifiers, token(i).text))
            ++i;
        made.type = i++;
        if (token(i).is("["))
            i = partner_[i] + 1;
        for (;;) {
            Declared::One one{.name = i++};
            while (token(i).is("[") && partner_[i] < tokens_.size())
                i = partner_[i] + 1;
            if (token(one.name).kind != Token::Kind::word || !token(i).is("="))
                return {};
            one.first = i + 1;
            one.last = i = next(one.first, {",", ";", ")", "}"});
            made.all.push_back(one);
            if (token(i).is(";"))
                break;
            if (!token(i++).is(","))
                return {};
        }
        made.end = i;
        return made;
    }
    void note_constants(std::size_t at) {
        const Declared made = declared(at);
        for (const Declared::One& one : made.all)
            constants_[token(one.name).text] = token(made.type).text;
    }
    /// Whether tokens look like an expression of constants; one that is none does no harm.
    [[nodiscard]] bool is_constant(std::size_t first, std::size_t last) const {
        constexpr auto allowed = std::to_array<std::string_view>(
            {"+", "-", "*", "/",  "%",  "(", ")", "[",  "]",  ",", ".", "!",  "~",  "<<", ">>",
             "&", "|", "^", "&&", "||", "?", ":", "==", "!=", "<", ">", "<=", ">=", "^^"});
        for (std::size_t i = first; i < last; ++i) {
            const Token& t = token(i);
            const bool is_known =
                t.kind == Token::Kind::number || (t.kind == Token::Kind::other && is_among(allowed, t.text)) ||
                (t.kind == Token::Kind::word &&
                 (t.is("true") || t.is("false") || (i > 0 && token(i - 1).is(".")) || constants_.contains(t.text) ||
                  is_among(conversions, t.text) || is_among(other_types, t.text) ||
                  (token(i + 1).is("(") && (is_among(restricted, t.text) || is_folded(t.text)))));
            if (!is_known)
                return false;
        }
        return first < last;
    }
    static bool has_fraction(const Token& t) {
        const bool is_hexadecimal = t.text.starts_with("0x") || t.text.starts_with("0X");
        return t.kind == Token::Kind::number && !is_hexadecimal && t.text.find_first_of(".eE") != std::string::npos;
    }
    /// Whether some number in it is no integer, as far as it says so.
    [[nodiscard]] bool says_float(std::size_t first, std::size_t last) const {
        for (std::size_t i = first; i < last; ++i) {
            const auto constant = constants_.find(token(i).text);
            if (has_fraction(token(i)) || is_among(other_types, token(i).text) ||
                (constant != constants_.end() && is_among(other_types, constant->second)))
                return true;
        }
        return false;
    }
    void wrap(std::size_t first, std::size_t last) {
        into_.emplace_back(token(first).begin, std::string(through) + "(");
        into_.emplace_back(token(last - 1).end(), ")");
    }
    /// The end of the operand behind an operator.
    [[nodiscard]] std::size_t operand_end(std::size_t i) const {
        while (token(i).is("-") || token(i).is("+") || token(i).is("~"))
            ++i;
        if (token(i).is("("))
            return partner_[i] + 1;
        ++i;
        for (;;)
            if ((token(i).is("(") || token(i).is("[")) && partner_[i] < tokens_.size())
                i = partner_[i] + 1;
            else if (token(i).is("."))
                i += 2;
            else
                return i;
    }
    /// Opens what begins at token i. Returns the last token that is done with.
    std::size_t take(std::size_t i) {
        const Token& t = token(i);
        const Token& before = i > 0 ? token(i - 1) : token(tokens_.size());
        const bool has_partner = token(i + 1).is("(") && partner_[i + 1] < tokens_.size();
        // What has to be a constant stays one.
        if ((t.is("layout") || (t.text.starts_with("texture") && t.text.find("Offset") != std::string::npos)) &&
            has_partner)
            return partner_[i + 1];
        if (t.is("case"))
            return next(i, {":"});
        if (t.is("[") && partner_[i] < tokens_.size() && i > 1 && is_declared(i))
            return partner_[i];
        if (t.is("const") && (before.text.empty() || before.is(";") || before.is("{") || before.is("}") ||
                              before.is(")") || before.is("else")))
            return take_declaration(i);
        if (but_.contains(t.line))
            return i;
        if (t.kind == Token::Kind::word && has_partner && !before.is("."))
            take_call(i);
        if ((t.is("/") || t.is("%") || t.is("<<") || t.is(">>")) &&
            (before.is(")") || before.is("]") || before.kind == Token::Kind::number ||
             constants_.contains(before.text))) {
            const std::size_t end = operand_end(i + 1);
            if (end <= tokens_.size() && is_constant(i + 1, end) && !(t.is("/") && says_float(i + 1, end)))
                wrap(i + 1, end);
        }
        return i;
    }
    /// Whether a bracket says how many elements a variable has, of whose declaration it is.
    [[nodiscard]] bool is_declared(std::size_t bracket) const {
        const Token& name = token(bracket - 1);
        const Token& type = token(bracket - 2);
        const auto is_type = [](const Token& one) {
            return is_among(conversions, one.text) || is_among(other_types, one.text);
        };
        return is_type(name) || name.is("]") ||
               (name.kind == Token::Kind::word && (type.kind == Token::Kind::word || type.is("]")) &&
                !type.is("return") && !type.is("else"));
    }
    void take_call(std::size_t i) {
        const std::size_t open = i + 1, close = partner_[open];
        if (!is_constant(open + 1, close))
            return;
        if (is_among(restricted, token(i).text))
            wrap(open + 1, next(open + 1, {",", ")"}));
        if (is_among(conversions, token(i).text) && says_float(open + 1, close))
            for (std::size_t first = open + 1; first < close;) {
                const std::size_t last = next(first, {",", ")"});
                wrap(first, last);
                first = last + 1;
            }
    }
    /// A constant stays as it is, on one line, and its value is computed once more behind it.
    std::size_t take_declaration(std::size_t at) {
        const Declared made = declared(at);
        const bool is_global = depth(at) == 0;
        if (made.all.empty() || but_.contains(token(at).line) || (is_es_ && is_global))
            return made.all.empty() ? at : made.end;
        Insertions outer;
        std::swap(into_, outer);
        for (const Declared::One& one : made.all)
            for (std::size_t i = one.first; i < one.last; ++i)
                i = take(i);
        std::swap(into_, outer);
        if (outer.empty())
            return made.end;
        std::string constant = text_.substr(token(at).begin, token(made.end).end() - token(at).begin);
        std::replace(constant.begin(), constant.end(), '\n', ' ');
        into_.emplace_back(token(at).begin, std::move(constant) + " ");
        hide(at);
        for (const Declared::One& one : made.all)
            into_.emplace_back(token(one.name).end(), fmt::format("_{}{}", through, into_.size()));
        into_.insert(into_.end(), outer.begin(), outer.end());
        return made.end;
    }
    /// In how many braces a token is.
    [[nodiscard]] int depth(std::size_t at) const {
        int braces = 0;
        for (std::size_t i = 0; i < at; ++i)
            braces += tokens_[i].is("{") ? 1 : tokens_[i].is("}") ? -1 : 0;
        return braces;
    }
    /// The word const goes: what is computed once more is no constant.
    void hide(std::size_t at) { std::fill_n(text_.begin() + static_cast<std::ptrdiff_t>(token(at).begin), 5, ' '); }

    std::string text_;
    bool is_es_;
    const std::set<std::size_t>& but_;
    std::vector<Token> tokens_; ///< of the text that was given
    std::vector<std::size_t> partner_;
    std::map<std::string_view, std::string_view> constants_; ///< with their types
    Insertions into_;
};

} // namespace

std::optional<std::string> with_open_constants(const std::string& text, bool is_es, const std::set<std::size_t>& but) {
    return Opener(text, is_es, but).opened();
}

} // namespace lockstep

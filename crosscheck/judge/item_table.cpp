#include "crosscheck/judge/item_table.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/step_rows.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

using Kind = RecordedRow::Kind;

/// Turns of a loop that a table shows, where the GPU told nothing of them.
constexpr int most_turns = 8;

/// Sites of one output are one step: the same field is written here or there.
using Key = std::tuple<Kind, std::uint32_t, int>;

/// Numbers what is come by at a site, or at those of one output.
class Counter {
  public:
    Key operator()(const Site& site, Kind kind) {
        const std::uint32_t id = site.output_id != 0 ? site.output_id : site.id;
        return {kind, id, seen_[{kind, id}]++};
    }

  private:
    std::map<std::pair<Kind, std::uint32_t>, int> seen_;
};

std::string texel_text(std::array<float, 2> texel) {
    return fmt::format("({}, {})", static_cast<int>(texel[0]), static_cast<int>(texel[1]));
}

/// One turn of a loop over texels, and how far it came.
struct Turn {
    std::array<float, 2> texel{};
    std::string came = {}; ///< in words
    std::optional<float> key = {};
    std::map<std::uint32_t, RecordedRow> values = {}; ///< by site
};

/// Whether a fetch opens a turn: a shader can tell of it.
bool opens_turn(const Site& site, Kind kind) { return kind == Kind::fetch && site.output_id != 0; }

/// What the reference came by, by itself.
struct Way {
    std::map<Key, RecordedRow> values;
    std::vector<Turn> turns;
    std::optional<Turn> chosen;
    bool chose = false;

    explicit Way(const std::vector<RecordedRow>& rows) {
        Counter counter;
        bool in_turn = false;
        for (const RecordedRow& row : rows) {
            if (opens_turn(*row.site, row.kind)) {
                turns.push_back({{row.values[0], row.values[1]}, row.values[2] != 0.0F ? "passed over" : "outside"});
                in_turn = true;
            } else if (row.kind == Kind::choice) {
                chose = true;
                in_turn = false;
                values.emplace(counter(*row.site, row.kind), row);
            } else if (in_turn) {
                add(turns.back(), row);
            } else if (row.kind == Kind::value || row.kind == Kind::decision) {
                values.emplace(counter(*row.site, row.kind), row);
            }
        }
    }

    [[nodiscard]] const Turn* turn(std::array<float, 2> texel) const {
        const auto found = std::find_if(turns.begin(), turns.end(), [&](const Turn& t) { return t.texel == texel; });
        return found == turns.end() ? nullptr : &*found;
    }
    [[nodiscard]] const RecordedRow* at(const Key& key) const {
        const auto found = values.find(key);
        return found == values.end() ? nullptr : &found->second;
    }

  private:
    void add(Turn& turn, const RecordedRow& row) {
        if (row.kind == Kind::texel &&
            std::all_of(row.values.begin(), row.values.end(), [](float x) { return x == 0.0F; }))
            turn.came = "empty";
        else if (row.kind == Kind::value)
            turn.values.emplace(row.site->id, row);
        if (row.kind != Kind::offer)
            return;
        const bool best = row.values[1] != 0.0F;
        turn.key = row.values[0];
        turn.came = best ? std::string(row.site->label) : "not taken";
        if (best)
            chosen = turn;
    }
};

/// What the GPU told of one turn.
struct ToldTurn {
    std::array<float, 2> texel{};
    std::map<std::string_view, std::span<const float>> values;
};

class ItemTable {
  public:
    ItemTable(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told)
        : pass_(pass), item_(item), strict_(pass.pass.record(pass.input(), item, named_profile("strict"))),
          reference_(pass.pass.record(pass.input(), item, pass.profile)),
          followed_(pass.pass.follow(pass.input(), item, pass.profile, pass.known, told)) {
        const Resource& about = pass.gpu.about();
        for (std::size_t f = 0; f < about.fields.size(); ++f)
            fields_.emplace(pass.pass.output(about, static_cast<std::uint8_t>(f)), field_label(about.fields[f]));
        is_shown_.resize(about.fields.size());
        for (const ToldValue& value : told) {
            captures_steps_ = captures_steps_ || !fields_.contains(value.output);
            if (value.turn >= 0)
                told_turns_[value.turn].values.emplace(value.output, value.values);
        }
        for (const ReadingRow& row : followed_.rows)
            tells_steps_ = tells_steps_ || (row.site->output_id != 0 && !fields_.contains(row.site->output));
        for (std::size_t i = 1; i < followed_.rows.size(); ++i)
            if (followed_.rows[i].kind == Kind::offer && followed_.rows[i - 1].kind == Kind::value)
                key_output_ = followed_.rows[i - 1].site->output;
    }

    std::vector<StepRow> operator()() {
        const std::vector<ReadingRow>& rows = followed_.rows;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const ReadingRow& row = rows[i];
            if (opens_turn(*row.site, row.kind)) {
                end_turn();
                turn_.assign(1, row);
            } else if (row.kind == Kind::choice) {
                end_turn();
                turns_elsewhere(row);
                choice(row);
            } else if (!turn_.empty()) {
                turn_.push_back(row);
            } else if (row.kind == Kind::decision) {
                // One that a value follows says no more than that.
                const bool named_next = i + 1 < rows.size() && rows[i + 1].site == row.site;
                if (!named_next)
                    decision(row);
                else
                    static_cast<void>(counter_(*row.site, row.kind));
            } else if (row.kind == Kind::value) {
                value(row);
            }
        }
        end_turn();
        fields_without_step();
        return std::move(rows_);
    }

  private:
    /// "(collision_twin.hpp:75)"
    static std::string line_of(const ReadingRow& row) {
        return fmt::format("({}:{})", std::filesystem::path(row.where.file_name()).filename().string(),
                           row.where.line());
    }
    std::string follows_text(std::string_view what, const ReadingRow& row) const {
        return captures_steps_
                   ? fmt::format("{} follows from the GPU's own values above {}", what, line_of(row))
                   : fmt::format("expected {} {}; the GPU's intermediate values were not captured", what, line_of(row));
    }
    std::string legal_text(const ReadingRow& row, std::size_t c) const {
        const Interval& legal = row.legal[c];
        if (legal.low == legal.high)
            return follows_text(fmt::format("{:.9g}", legal.low), row);
        return captures_steps_ ? fmt::format("{:.9g} to {:.9g} would be legal {}", legal.low, legal.high, line_of(row))
                               : follows_text(fmt::format("{:.9g} to {:.9g}", legal.low, legal.high), row);
    }

    /// Of a field its name, of anything else the site's.
    [[nodiscard]] std::string label_of(const Site& site, int occurrence = 0) const {
        const auto field = fields_.find(site.output);
        const std::string label(field == fields_.end() ? site.label : field->second);
        return occurrence > 0 ? fmt::format("{} [{}]", label, occurrence) : label;
    }
    void note_shown(const ReadingRow& row) {
        const Resource& about = pass_.gpu.about();
        for (std::size_t f = 0; f < about.fields.size(); ++f)
            if (pass_.pass.output(about, static_cast<std::uint8_t>(f)) == row.site->output)
                is_shown_[f] = true;
    }
    [[nodiscard]] bool is_shown(const ReadingRow& row, int occurrence) {
        if (row.is_told)
            return true;
        if (tells_steps_ && row.site->output_id == 0)
            return false;
        left_out_ += occurrence >= most_turns ? 1 : 0;
        return occurrence < most_turns;
    }
    void note_left_out(int occurrence) {
        if (occurrence == 0 && left_out_ > 0)
            rows_.push_back({.label = fmt::format("({} more of the loop)", std::exchange(left_out_, 0))});
    }

    /// What the item holds where no step has the field's name: packed words, and what is only copied.
    void fields_without_step() {
        const Resource& about = pass_.gpu.about();
        const std::vector<Component> parts = components(about);
        const auto strict = pass_.pass.mistaken(pass_.input(), item_, named_profile("strict"), {});
        const auto outcomes = pass_.on_input().outcomes(pass_.input(), item_, pass_.profile, pass_.known, &pass_.gpu);
        for (std::size_t at = 0; at < parts.size(); ++at) {
            const Field& field = about.fields[parts[at].field];
            if (is_shown_[parts[at].field])
                continue;
            const auto of = [&](const View& state) { return state.value(parts[at].field, item_, parts[at].component); };
            StepRow out{.label = field_label(field)};
            if (field.components > 1)
                out.label += fmt::format(".{}", "xyzw"[parts[at].component]);
            out.strict = cell(Value{field.scalar, strict[at]});
            out.reference = cell(of(pass_.reference));
            out.gpu = cell(of(pass_.gpu));
            const bool legal = std::any_of(outcomes.begin(), outcomes.end(), [&](const ItemOutcome& one) {
                return one.values[at].any || holds(one.values[at], of(pass_.gpu));
            });
            judge_.put(out, same_bits(of(pass_.reference), of(pass_.gpu)), {legal, false}, RowVerdict::rounding, [&] {
                return lockstep::legal_text(outcomes.front().values[at], field.scalar) + " would be legal";
            });
            rows_.push_back(std::move(out));
        }
    }
    static Cell cell(const Value& value) {
        return value.scalar == Scalar::float32 ? Cell{value.real(), {}} : Cell{{}, fmt::format("{}", value.integer())};
    }
    static bool holds(const Interval& legal, const Value& value) {
        if (value.scalar == Scalar::float32)
            return legal.contains(value.real());
        const auto x = static_cast<double>(value.integer());
        return legal.low <= x && x <= legal.high;
    }

    void value(const ReadingRow& row) {
        const Key key = counter_(*row.site, row.kind);
        const int occurrence = std::get<2>(key);
        if (!is_shown(row, occurrence))
            return;
        note_left_out(occurrence);
        numbers(row, label_of(*row.site, occurrence), strict_.at(key), reference_.at(key));
    }

    void numbers(const ReadingRow& row, const std::string& label, const RecordedRow* strict,
                 const RecordedRow* reference) {
        const auto size = static_cast<std::size_t>(row.size);
        note_shown(row);
        if (row.is_integer)
            return integers(row, label, strict, reference);
        for (std::size_t c = 0; c < size; ++c) {
            const auto of = [c](const RecordedRow* r) {
                return r != nullptr && static_cast<int>(c) < r->size ? std::optional(r->values[c]) : std::nullopt;
            };
            StepRow out{.label = size > 1 ? fmt::format("{}.{}", label, "xyzw"[c]) : label,
                        .strict = {of(strict), {}},
                        .reference = {of(reference), {}}};
            if (row.is_told) {
                out.gpu.number = row.told[c];
                const bool same = of(reference) && same_bits(*of(reference), row.told[c]);
                judge_.put(out, same, {row.legal[c].contains(row.told[c]), row.legal[c].any}, RowVerdict::rounding,
                           [&] { return legal_text(row, c); });
            }
            rows_.push_back(std::move(out));
        }
    }

    /// In one cell: "3", "(3, 4)".
    void integers(const ReadingRow& row, const std::string& label, const RecordedRow* strict,
                  const RecordedRow* reference) {
        const auto size = static_cast<std::size_t>(row.size);
        const auto text = [size](const auto& values) {
            std::string all;
            for (std::size_t c = 0; c < size; ++c)
                all += fmt::format("{}{}", all.empty() ? "" : ", ", static_cast<long>(values[c]));
            return size > 1 ? "(" + all + ")" : all;
        };
        StepRow out{.label = label};
        out.strict.text = strict != nullptr ? text(strict->values) : "";
        out.reference.text = reference != nullptr ? text(reference->values) : "";
        if (row.is_told) {
            out.gpu.text = text(row.told);
            std::array<double, 4> lowest{};
            bool open = false;
            for (std::size_t c = 0; c < size; ++c) {
                lowest[c] = row.legal[c].low;
                open = open || row.legal[c].any;
            }
            judge_.put(out, out.gpu.text == out.reference.text, {row.is_legal(), open}, RowVerdict::tie,
                       [&] { return follows_text(text(lowest), row); });
        }
        rows_.push_back(std::move(out));
    }

    void decision(const ReadingRow& row) {
        const Key key = counter_(*row.site, row.kind);
        if (!is_shown(row, std::get<2>(key)))
            return;
        note_left_out(std::get<2>(key));
        const auto text = [](const RecordedRow* r) { return r == nullptr ? "" : r->values[0] != 0.0F ? "yes" : "no"; };
        StepRow out{.label = label_of(*row.site, std::get<2>(key)),
                    .strict = {{}, text(strict_.at(key))},
                    .reference = {{}, text(reference_.at(key))}};
        if (row.is_told) {
            const bool yes = row.told[0] != 0.0F;
            out.gpu.text = yes ? "yes" : "no";
            judge_.put(out, out.gpu.text == out.reference.text, {row.is_legal(), row.legal[0].any}, RowVerdict::tie,
                       [&] { return follows_text(yes ? "no" : "yes", row); });
        }
        rows_.push_back(std::move(out));
    }

    [[nodiscard]] const ToldTurn* told_turn(std::string_view fetch, std::array<float, 2> texel) const {
        for (const auto& [number, turn] : told_turns_)
            if (const auto told = turn.values.find(fetch); told != turn.values.end() && told->second.size() >= 2 &&
                                                           told->second[0] == texel[0] && told->second[1] == texel[1])
                return &turn;
        return nullptr;
    }

    static Cell cell(const Way& way, std::array<float, 2> texel) {
        if (!way.chose)
            return {};
        const Turn* turn = way.turn(texel);
        return turn == nullptr ? Cell{{}, "not looked at"} : Cell{turn->key, turn->came};
    }
    StepRow turn_row(std::array<float, 2> texel) const {
        return {.label = "texel " + texel_text(texel),
                .strict = cell(strict_, texel),
                .reference = cell(reference_, texel),
                .is_fetch = true};
    }
    void put_turn(StepRow out, Cell gpu, RowJudge::Legality legality, const std::function<std::string()>& reason) {
        out.gpu = std::move(gpu);
        const bool alike = out.gpu.text == out.reference.text;
        const bool same = alike && out.gpu.number.has_value() == out.reference.number.has_value() &&
                          (!out.gpu.number || same_bits(*out.gpu.number, *out.reference.number));
        judge_.put(out, same, legality, alike ? RowVerdict::rounding : RowVerdict::tie, reason);
        rows_.push_back(std::move(out));
    }

    /// The rows of a turn: its values but for the last, which is its key, only where the GPU's differ.
    void end_turn() {
        if (turn_.empty())
            return;
        const std::vector<ReadingRow> turn = std::exchange(turn_, {});
        const ReadingRow& fetch = turn.front();
        const std::array texel{fetch.told[0], fetch.told[1]};
        looked_at_.push_back(texel);
        const Turn* in_reference = reference_.turn(texel);
        const Turn* in_strict = strict_.turn(texel);
        const ReadingRow *key = nullptr, *offer = nullptr;
        std::string should = fetch.told[2] != 0.0F ? "passed over" : "outside";
        for (const ReadingRow& row : turn) {
            if (row.kind == Kind::texel &&
                std::all_of(row.legal.begin(), row.legal.end(), [](const Interval& code) { return code.low == 0.0; }))
                should = "empty";
            if (row.kind == Kind::value && row.size == 1)
                key = &row;
            if (row.kind == Kind::offer)
                offer = &row;
        }
        const auto of = [](const Turn* t, const ReadingRow& row) -> const RecordedRow* {
            return t != nullptr && t->values.contains(row.site->id) ? &t->values.at(row.site->id) : nullptr;
        };
        for (const ReadingRow& row : turn) {
            if (row.kind != Kind::value || &row == key || !row.is_told)
                continue;
            const RecordedRow* reference = of(in_reference, row);
            if (reference != nullptr ? !is_as_in(row, *reference) : !row.is_legal())
                numbers(row, fmt::format("{} {}", row.site->label, texel_text(texel)), of(in_strict, row), reference);
        }
        StepRow out = turn_row(texel);
        if (told_turns_.empty())
            return rows_.push_back(std::move(out));
        if (offer != nullptr)
            should = offer->legal[0].low > 0.0 ? std::string(offer->site->label) : "not taken";
        const ToldTurn* told = told_turn(fetch.site->output, texel);
        Cell gpu{{}, "not looked at"};
        bool legal = false;
        if (told != nullptr) {
            gpu =
                told_cell(*told, fetch.site->output, offer == nullptr && should != "outside" ? should : "passed over");
            legal = offer != nullptr ? offer->is_told && offer->is_legal() : gpu.text == should;
            if (offer != nullptr && offer->is_told && offer->told[0] != 0.0F)
                picked_ = texel;
        }
        const bool key_is_legal = key == nullptr || key->is_legal();
        put_turn(std::move(out), std::move(gpu), {legal && key_is_legal, key != nullptr && key->legal[0].any}, [&] {
            return key_is_legal ? follows_text("\"" + should + "\"", offer != nullptr ? *offer : fetch)
                                : legal_text(*key, 0);
        });
    }
    static bool is_as_in(const ReadingRow& row, const RecordedRow& reference) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(row.size); ++c)
            if (!same_bits(row.told[c], reference.values[c]))
                return false;
        return true;
    }

    /// The site that turns are offered to, where it can be told of.
    [[nodiscard]] const Site* choice_site() const {
        const auto found = std::find_if(followed_.rows.begin(), followed_.rows.end(),
                                        [](const ReadingRow& row) { return row.kind == Kind::choice; });
        return found == followed_.rows.end() ? nullptr : found->site;
    }
    /// What the GPU told of a turn's offer; null: it made none.
    [[nodiscard]] const std::span<const float>* offered_in(const ToldTurn& told) const {
        const Site* site = choice_site();
        const auto found = site == nullptr ? told.values.end() : told.values.find(site->output);
        return found == told.values.end() ? nullptr : &found->second;
    }
    /// `passed_over`: the word for a texel that was read and not offered.
    [[nodiscard]] Cell told_cell(const ToldTurn& told, std::string_view fetch, const std::string& passed_over) const {
        if (const auto* offered = offered_in(told)) {
            const auto key = told.values.find(key_output_);
            return {key == told.values.end() ? std::nullopt : std::optional(key->second[0]),
                    (*offered)[0] != 0.0F ? std::string(choice_site()->label) : "not taken"};
        }
        const std::span<const float>& fetched = told.values.at(fetch);
        return {{}, fetched.size() < 3 || fetched[2] != 0.0F ? passed_over : "outside"};
    }

    /// Texels that this way does not look at: the reference does, from another place; or the GPU does.
    void turns_elsewhere(const ReadingRow& choice) {
        const auto is_new = [&](std::array<float, 2> texel) {
            return std::find(looked_at_.begin(), looked_at_.end(), texel) == looked_at_.end();
        };
        for (const Turn& turn : reference_.turns)
            if (is_new(turn.texel)) {
                looked_at_.push_back(turn.texel);
                StepRow out = turn_row(turn.texel);
                if (told_turns_.empty())
                    rows_.push_back(std::move(out));
                else
                    put_turn(std::move(out), {{}, "not looked at"}, {true, false}, {});
            }
        for (const auto& [number, told] : told_turns_) {
            const auto* const offered = offered_in(told);
            for (const auto& [output, values] : told.values) {
                const std::array texel{values[0], values.size() > 1 ? values[1] : 0.0F};
                if (output != fetch_output_of_turns() || offered == nullptr || !is_new(texel))
                    continue;
                put_turn(turn_row(texel), told_cell(told, output, "passed over"), {false, false},
                         [&] { return follows_text("\"not looked at\"", choice); });
                if ((*offered)[0] != 0.0F)
                    picked_ = texel;
            }
        }
    }
    [[nodiscard]] std::string_view fetch_output_of_turns() const {
        const auto found = std::find_if(followed_.rows.begin(), followed_.rows.end(),
                                        [](const ReadingRow& row) { return opens_turn(*row.site, row.kind); });
        return found == followed_.rows.end() ? std::string_view() : found->site->output;
    }

    void choice(const ReadingRow& row) {
        const Key key = counter_(*row.site, row.kind);
        const auto text = [&](const Way& way) {
            const RecordedRow* made = way.at(key);
            return made == nullptr        ? std::string()
                   : made->values[0] == 0 ? std::string("none")
                   : way.chosen           ? texel_text(way.chosen->texel)
                                          : std::string("found");
        };
        StepRow out{.label = label_of(*row.site), .strict = {{}, text(strict_)}, .reference = {{}, text(reference_)}};
        if (row.is_told) {
            const bool of_turns = !told_turns_.empty();
            const std::string follows = picked_                               ? texel_text(*picked_)
                                        : !of_turns && row.legal[0].low > 0.0 ? "some texel"
                                                                              : "none";
            out.gpu.text = row.told[0] == 0.0F ? "none" : picked_ ? follows : "some texel";
            const bool same = of_turns ? out.gpu.text == out.reference.text
                                       : (out.gpu.text == "none") == (out.reference.text == "none");
            judge_.put(out, same, {out.gpu.text == follows, false}, RowVerdict::tie,
                       [&] { return follows_text(follows, row); });
            // What the step never offered it cannot go on from: what comes after is not blamed.
            if (!row.is_legal())
                judge_.lose_the_way();
        }
        rows_.push_back(std::move(out));
    }

    const JudgedPass& pass_;
    std::size_t item_;
    std::vector<bool> is_shown_; ///< by field
    Way strict_, reference_;
    FollowedStep followed_;
    std::map<std::string_view, std::string> fields_; ///< names, by output
    std::map<int, ToldTurn> told_turns_;
    bool captures_steps_ = false; ///< the GPU's values in between are there, not its fields alone
    bool tells_steps_ = false;    ///< sites have outputs besides the fields'
    std::string_view key_output_; ///< by which the GPU tells of a turn's key
    Counter counter_;
    RowJudge judge_;
    std::vector<ReadingRow> turn_;                ///< the one that is being made: its fetch first
    std::vector<std::array<float, 2>> looked_at_; ///< texels
    std::optional<std::array<float, 2>> picked_;  ///< by the GPU
    int left_out_ = 0;
    std::vector<StepRow> rows_;
};

} // namespace

std::string field_label(const Field& field) {
    std::string label = field.name;
    std::replace(label.begin(), label.end(), '_', ' ');
    return label;
}

std::string legal_text(const Interval& legal, Scalar scalar) {
    if (legal.any)
        return "anything";
    const auto text = [&](double x) {
        return scalar == Scalar::float32 ? fmt::format("{:.9g}", x) : fmt::format("{:.0f}", x);
    };
    return legal.low == legal.high ? text(legal.low) : fmt::format("{} to {}", text(legal.low), text(legal.high));
}

std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told) {
    return item_rows(pass, item, told, steps_of_item(pass, item));
}

std::vector<StepRow> item_rows(const JudgedPass& pass, std::size_t item, std::span<const ToldValue> told,
                               const std::optional<ItemSteps>& text) {
    std::vector<StepRow> rows = ItemTable(pass, item, told)();
    if (text)
        align(rows, *text);
    return rows;
}

std::optional<ItemSteps> steps_of_item(const JudgedPass& pass, std::size_t item) {
    return pass.text == nullptr ? std::nullopt : std::optional(pass.text->of(pass.input(), item, pass.profile));
}

std::vector<ToldValue> told_by_state(const ItemPass& pass, const View& gpu, std::size_t item) {
    std::vector<ToldValue> told;
    for (std::size_t f = 0; f < gpu.fields().size(); ++f) {
        ToldValue value{std::string(pass.output(gpu.about(), static_cast<std::uint8_t>(f))), {}};
        for (int c = 0; c < gpu.fields()[f].components; ++c) {
            const Value v = gpu.value(f, item, c);
            value.values.push_back(v.scalar == Scalar::float32 ? v.real() : static_cast<float>(v.integer()));
        }
        told.push_back(std::move(value));
    }
    return told;
}

} // namespace lockstep

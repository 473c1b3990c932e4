#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/judge/system_check.hpp"
#include "crosscheck/report/page/page_parts.hpp"

namespace lockstep {

/// Gathers what the report page of any system shows while a check runs: of each pass in each frame how much differs,
/// the first items that do with their step tables, and which texels of images.
class SystemPage {
  public:
    static constexpr std::size_t items_of_class = 12; ///< a pass, with step tables
    static constexpr std::size_t most_items = 60;
    static constexpr std::size_t examples = 6;        ///< where everything agrees
    static constexpr std::size_t detailed = 24;       ///< passes of a frame of which items are told
    static constexpr std::size_t items_told = 40;     ///< of such a one, with both sides' values
    static constexpr std::size_t texels_told = 20000; ///< of such a one, by place and class
    static constexpr std::size_t counted_rows = 50000;

    /// `system` and `gpu` outlive this.
    SystemPage(const System& system, SystemSide& gpu, int frames) : system_(system), gpu_(gpu), frames_(frames) {}

    void add(const CheckedPass& checked);

    /// The command that shows an item's step, which these words name: "--frame", "3", "--pass", "update", ...
    using ExplainLine = std::function<std::string(const std::vector<std::string>& words)>;

    /// The page, at most largest_page bytes. `drawn`: what is said of the picture; empty: nothing.
    [[nodiscard]] std::string text(std::string_view page_template, const CheckReport& report,
                                   const RunDescription& description, const std::vector<PageCommand>& commands,
                                   const ExplainLine& explain_line, const std::string& drawn) const;

  private:
    using Counts = std::array<std::uint64_t, class_names.size() + 1>; ///< by class; last: not judged
    /// Of one pass, over the run.
    struct Total {
        int frames = 0; ///< in which it ran
        std::uint64_t compared = 0, differing = 0;
        Counts classes{};
        std::int64_t worst_ulp = 0;
        int first_frame = -1;
    };
    struct Item {
        int frame = 0;
        std::size_t pass = 0, index = 0;
        std::size_t kind = 0;     ///< a class, or as page_same
        nlohmann::json told = {}; ///< its table
    };

    void note_items(const CheckedPass& checked);
    void note_examples(const CheckedPass& checked);
    void keep(const CheckedPass& checked, std::size_t index, std::size_t kind);
    [[nodiscard]] nlohmann::json item_json(const Item& item) const;
    [[nodiscard]] nlohmann::json passes_json() const;

    const System& system_;
    SystemSide& gpu_;
    int frames_;
    std::map<std::size_t, Total> totals_; ///< by pass
    nlohmann::json rows_ = nlohmann::json::array(), details_ = nlohmann::json::array();
    int left_out_from_ = -1;                                          ///< the first frame whose rows had no room
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> kept_; ///< items, by pass and class
    std::vector<Item> items_;
};

} // namespace lockstep

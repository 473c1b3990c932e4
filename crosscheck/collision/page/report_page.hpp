#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/page/frame_keeper.hpp"
#include "crosscheck/collision/page/series.hpp"
#include "crosscheck/report/page/page_parts.hpp"
#include "crosscheck/report/report.hpp"

namespace lockstep {

/// Gathers what the report page shows while a check runs.
class PageCollector {
  public:
    /// `scene` has to outlive this.
    PageCollector(const Scene& scene, const Profile& profile, CheckMode mode, int frames);

    /// Every frame, in order.
    void add(const ComparedFrame& frame);

    [[nodiscard]] const FrameKeeper& frames() const { return keeper_; }
    [[nodiscard]] const DifferenceSeries& series() const { return series_; }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const Profile& profile() const { return profile_; }

  private:
    const Scene& scene_;
    Profile profile_;
    DifferenceSeries series_;
    FrameKeeper keeper_;
    Particles before_; ///< the GPU's, which the next frame starts from
    CollisionImage cdt_before_;
};

/// An item and what is told of it.
struct ExplainedItem {
    PageItem item;
    std::string command; ///< shows the same in a terminal
    nlohmann::json told; ///< explained(), or null where it could not be made
};

/// Both sides' rendered frame and their difference.
struct RenderedPictures {
    int frame = 0;
    std::vector<PagePicture> pictures; ///< none: nothing was rendered
};

/// The page: `page_template` (template.hpp) with the run's data in it; one file, at most largest_page bytes unless the
/// step tables alone are more. `study`: study_results(), or null.
std::string report_page(std::string_view page_template, const PageCollector& run, const CheckReport& report,
                        const RunDescription& description, const std::vector<PageCommand>& commands,
                        const std::vector<ExplainedItem>& items, const nlohmann::json& study,
                        const RenderedPictures& rendered = {});

} // namespace lockstep

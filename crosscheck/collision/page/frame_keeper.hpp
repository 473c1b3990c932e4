#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/page/frame_blobs.hpp"

namespace lockstep {

/// A particle or texel whose step table the page shows.
struct PageItem {
    int frame = 0;
    bool texel = false; ///< else a particle
    std::size_t index = 0;
    std::uint8_t kind = class_same; ///< a DifferenceClass, class_unjudged, or class_same: an example that agrees
};

/// A frame of which the page has pictures and values.
struct KeptFrame {
    int frame = 0;
    bool differs = false;
    std::string picture; ///< base64 of a deflated picture_blob
    std::string detail;  ///< of a detail_blob of what differs; empty: nothing does
    std::string whole;   ///< of one of the whole frame; empty: there was no room
};

/// Keeps frames while a check runs: the first ones that differ, later ones at doubling distance, the first, the last,
/// and some evenly between; as many as find room on the page.
class FrameKeeper {
  public:
    static constexpr std::size_t items_of_a_class = 12; ///< particles, and as many texels
    static constexpr std::size_t examples = 6;

    /// `scene` has to outlive this.
    FrameKeeper(const Scene& scene, const Profile& profile, int frames);

    void add(const ComparedFrame& frame, const Particles& before, const FrameParams& params);

    /// The first of each class, by frame.
    [[nodiscard]] std::vector<PageItem> items() const;

    /// What fits into `room` bytes, by frame: the first that differs before all others, then the last, then evenly.
    [[nodiscard]] std::vector<KeptFrame> within(std::size_t room) const;

  private:
    [[nodiscard]] bool wanted(int frame, bool differs) const;
    void keep(const ComparedFrame& frame, const Particles& before, const FrameParams& params,
              const FrameClasses& classes);
    void note_items(const ComparedFrame& frame, const FrameClasses& classes);
    void note_examples(const ComparedFrame& frame);

    const Scene& scene_;
    Profile profile_;
    int frames_;
    int spread_;      ///< between frames that are kept whatever they hold
    bool keep_whole_; ///< every kept frame has all its values
    std::size_t differing_frames_ = 0;
    std::vector<KeptFrame> kept_;
    std::map<std::pair<std::uint8_t, bool>, std::vector<PageItem>> items_; ///< by class, particles and texels
};

} // namespace lockstep

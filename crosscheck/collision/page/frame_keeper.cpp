#include "crosscheck/collision/page/frame_keeper.hpp"

#include <algorithm>
#include <bit>

#include "crosscheck/collision/report/pictures.hpp"
#include "crosscheck/files/base64.hpp"
#include "reference/model/collision/collision_state.hpp"

namespace lockstep {
namespace {

constexpr std::size_t most_pictures = 240;
constexpr std::size_t first_differing = 12;   ///< frames with a difference that are kept one by one
constexpr std::size_t values_of_first = 2000; ///< differing texels and particles told of the first such frame
constexpr std::size_t values_of_later = 250;

/// Rough sizes on the page.
constexpr std::size_t room = 5'000'000;
constexpr std::size_t bytes_of_texel = 2;   ///< in a picture
constexpr std::size_t bytes_of_values = 30; ///< of a particle and its texel
constexpr std::size_t room_for_whole = 800'000;

std::size_t texels(const Scene& scene) {
    return static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
}

std::size_t pictures(const Scene& scene) {
    const std::size_t bytes = 2000 + texels(scene) / 16 + bytes_of_texel * std::min(scene.start.size(), texels(scene));
    return std::clamp<std::size_t>(room / bytes, 8, most_pictures);
}

std::string packed(const Blob& blob) { return base64(deflated(blob.str())); }

/// 0: before all others.
int rank(const KeptFrame& frame, int first_difference, int frames, int spread) {
    if (frame.frame == first_difference)
        return 0;
    if (frame.frame == frames - 1)
        return 1;
    if (frame.frame % spread != 0)
        return 40;
    const auto step = static_cast<unsigned>(frame.frame / spread);
    return step == 0 ? 2 : 35 - std::countr_zero(step);
}

} // namespace

FrameKeeper::FrameKeeper(const Scene& scene, const Profile& profile, int frames)
    : scene_(scene), profile_(profile), frames_(frames) {
    const std::size_t count = pictures(scene);
    spread_ = std::max(1, (frames - 1) / static_cast<int>(count) + 1);
    const std::size_t kept = std::min(static_cast<std::size_t>(frames), count + first_differing);
    keep_whole_ = scene.start.size() * bytes_of_values * kept <= room_for_whole;
}

bool FrameKeeper::wanted(int frame, bool differs) const {
    return frame % spread_ == 0 || frame + 1 == frames_ ||
           (differs && (differing_frames_ < first_differing || std::has_single_bit(differing_frames_)));
}

void FrameKeeper::add(const ComparedFrame& frame, const Particles& before, const FrameParams& params) {
    const bool differs = !frame.comparison.agree();
    note_examples(frame);
    if (differs || wanted(frame.frame, differs)) {
        const FrameClasses classes = classes_of(frame);
        note_items(frame, classes);
        if (wanted(frame.frame, differs))
            keep(frame, before, params, classes);
    }
    if (differs)
        ++differing_frames_;
}

void FrameKeeper::keep(const ComparedFrame& frame, const Particles& before, const FrameParams& params,
                       const FrameClasses& classes) {
    const bool differs = !frame.comparison.agree();
    const bool first = differs && differing_frames_ == 0;
    const BothOwners owners = owners_of(frame, before, scene_, params, profile_);
    KeptFrame kept{frame.frame, differs, packed(picture_blob(frame, classes, code_box(frame.reference_cdt))), {}, {}};
    if (keep_whole_ || first || frame.frame + 1 == frames_)
        kept.whole = packed(detail_blob(frame, classes, owners, whole_frame(frame)));
    if (differs)
        kept.detail =
            packed(detail_blob(frame, classes, owners, differing(classes, first ? values_of_first : values_of_later)));
    kept_.push_back(std::move(kept));
}

void FrameKeeper::note_items(const ComparedFrame& frame, const FrameClasses& classes) {
    if (frame.comparison.agree())
        return;
    const auto note = [&](const std::vector<std::uint8_t>& kinds, bool texel) {
        for (std::size_t i = 0; i < kinds.size(); ++i)
            if (kinds[i] != class_same)
                if (auto& items = items_[{kinds[i], texel}]; items.size() < items_of_a_class)
                    items.push_back({frame.frame, texel, i, kinds[i]});
    };
    note(classes.particles, false);
    if (frame.comparison.compared(collision::cdt) > 0)
        note(classes.texels, true);
}

void FrameKeeper::note_examples(const ComparedFrame& frame) {
    auto& items = items_[{class_same, false}];
    if (!frame.comparison.agree() || items.size() == examples)
        return;
    for (std::size_t i = 0; i < frame.reference.size() && items.size() < examples; ++i)
        if (frame.reference.collide_time[i] == scene_.constants.collision_time)
            items.push_back({frame.frame, false, i, class_same});
}

std::vector<PageItem> FrameKeeper::items() const {
    std::vector<PageItem> all;
    for (const auto& [kind_and_texel, items] : items_)
        all.insert(all.end(), items.begin(), items.end());
    std::stable_sort(all.begin(), all.end(), [](const PageItem& a, const PageItem& b) { return a.frame < b.frame; });
    return all;
}

std::vector<KeptFrame> FrameKeeper::within(std::size_t bytes) const {
    const auto first = std::find_if(kept_.begin(), kept_.end(), [](const KeptFrame& frame) { return frame.differs; });
    const int first_difference = first == kept_.end() ? -1 : first->frame;
    std::vector<KeptFrame> frames = kept_;
    std::stable_sort(frames.begin(), frames.end(), [&](const KeptFrame& a, const KeptFrame& b) {
        return rank(a, first_difference, frames_, spread_) < rank(b, first_difference, frames_, spread_);
    });
    // Pictures first; all values of a frame where nearly half of the room is left for pictures.
    std::size_t used = 0;
    const auto fits = [&](const std::string& blob) { return used + blob.size() <= bytes; };
    std::vector<KeptFrame> chosen;
    for (KeptFrame& frame : frames) {
        const std::size_t size = frame.picture.size() + frame.detail.size();
        if (used + size > bytes)
            continue;
        used += size;
        std::string whole = std::move(frame.whole);
        frame.whole.clear();
        if (!whole.empty() && fits(whole) && (keep_whole_ || used + whole.size() <= bytes / 20 * 11)) {
            used += whole.size();
            frame.whole = std::move(whole);
        }
        chosen.push_back(std::move(frame));
    }
    std::sort(chosen.begin(), chosen.end(), [](const KeptFrame& a, const KeptFrame& b) { return a.frame < b.frame; });
    return chosen;
}

} // namespace lockstep

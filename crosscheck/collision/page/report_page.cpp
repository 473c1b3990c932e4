#include "crosscheck/collision/page/report_page.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/collision/page/live_scene.hpp"
#include "crosscheck/files/base64.hpp"
#include "crosscheck/report/page/blob.hpp"
#include "reference/model/collision/layered_cdt.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

json item_json(const ExplainedItem& explained, int width) {
    const PageItem& item = explained.item;
    json out{{"frame", item.frame}, {"class", item.kind}, {"command", explained.command}};
    const auto columns = static_cast<std::size_t>(width);
    if (item.texel)
        out["texel"] = {item.index % columns, item.index / columns};
    else
        out["particle"] = item.index;
    // The list shows where it first goes wrong; the table itself is read when asked for.
    const auto note_step = [&](const json& rows) {
        for (const json& row : rows)
            if (row.at("verdict") == "DIVERGENT" && !out.contains("step"))
                out["step"] = row.at("label");
    };
    if (explained.told.is_null())
        return out;
    for (const json& particle : explained.told.at("particles"))
        note_step(particle.at("rows"));
    if (explained.told.contains("texel"))
        note_step(explained.told.at("texel").at("rows"));
    return out;
}

/// Of pictures that would leave no room for anything else, nothing.
json rendered_json(const RenderedPictures& rendered) {
    constexpr std::size_t room = 1'500'000;
    std::size_t size = 0;
    json pictures = json::array();
    for (const PagePicture& picture : rendered.pictures) {
        pictures.push_back({{"title", picture.title}, {"png", base64(picture.png)}});
        size += picture.png.size() * 4 / 3;
    }
    return size == 0 || size > room ? json() : json{{"frame", rendered.frame}, {"pictures", std::move(pictures)}};
}

} // namespace

PageCollector::PageCollector(const Scene& scene, const Profile& profile, CheckMode mode, int frames)
    : scene_(scene), profile_(profile), series_(scene, profile, mode), keeper_(scene, profile, frames),
      before_(scene.start), cdt_before_(empty_cdt(scene)) {}

void PageCollector::add(const ComparedFrame& frame) {
    const FrameParams params = frame_params(scene_, frame.frame);
    series_.add(frame, before_, cdt_before_, params);
    keeper_.add(frame, before_, params);
    before_ = frame.gpu;
    cdt_before_ = frame.gpu_cdt;
}

std::string report_page(std::string_view page_template, const PageCollector& run, const CheckReport& report,
                        const RunDescription& description, const std::vector<PageCommand>& commands,
                        const std::vector<ExplainedItem>& items, const json& study, const RenderedPictures& rendered) {
    json tables = json::array(), listed = json::array();
    for (const ExplainedItem& item : items) {
        listed.push_back(item_json(item, run.scene().width));
        tables.push_back(item.told);
    }
    const CollisionImage cdt = empty_cdt(run.scene());
    json head = page_head(report, description, commands);
    head.update({{"width", cdt.width},
                 {"height", cdt.height},
                 {"plane_height", run.scene().height},
                 {"format", switch_value(run.scene().switches, "cdt_format")},
                 {"items", listed},
                 {"study", study},
                 {"rendered", rendered_json(rendered)}});
    std::string blobs;
    const auto add = [&](const std::string& id, const std::string& base64) { blobs += blob_element(id, base64); };
    add("series", packed_json(run.series().json()));
    add("tables", packed_json(tables));
    const LiveScene live = live_scene(run.scene(), report.frames, run.profile());
    const std::string arrays = base64(deflated(live.arrays.str()));
    constexpr std::size_t room_for_live = 3'000'000;
    const bool fits = arrays.size() <= room_for_live;
    add("live",
        packed_json(fits ? live.head : json{{"unavailable", "its particles and obstacles have no room on the page"}}));
    add("live-arrays", fits ? arrays : base64(deflated("")));

    constexpr std::size_t of_head = 60'000; // the list of frames is not in it yet
    const std::size_t used = page_template.size() + blobs.size() + page_text(head).size() + of_head;
    json frames = json::array();
    for (const KeptFrame& frame : run.frames().within(largest_page - std::min(used, largest_page))) {
        const std::string& detail = frame.whole.empty() ? frame.detail : frame.whole;
        frames.push_back({{"frame", frame.frame},
                          {"differs", frame.differs},
                          {"detail", detail.empty()        ? "none"
                                     : frame.whole.empty() ? "differing"
                                                           : "whole"}});
        add(fmt::format("picture-{}", frame.frame), frame.picture);
        if (!detail.empty())
            add(fmt::format("detail-{}", frame.frame), detail);
    }
    head["frames"] = std::move(frames);

    return filled_page(page_template, head, blobs);
}

} // namespace lockstep

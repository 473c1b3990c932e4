#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crosscheck/files/json_reader.hpp"

namespace lockstep {

/// The files that a JSON document names, each read once: those that lie beside it, or those that were carried along
/// with it.
class NamedFiles {
  public:
    using Contents = std::map<std::string, std::string>; ///< bytes, by the names in the document

    /// Beside the document.
    NamedFiles() = default;
    /// Carried along, and no others.
    explicit NamedFiles(Contents carried) : contents_(std::move(carried)), is_carried_(true) {}

    struct File {
        std::string name; ///< for messages
        std::string_view bytes;
    };
    /// What lies under a name. `kind`: what it is to be ("PNG file"). Throws Error where there is no such file.
    File read(const JsonValue& named, std::string_view kind);

    /// All that were read, to be carried along.
    [[nodiscard]] const Contents& contents() const { return contents_; }
    /// Where they lie; none, of those that were carried.
    [[nodiscard]] const std::vector<std::filesystem::path>& places() const { return places_; }

  private:
    Contents contents_;
    std::vector<std::filesystem::path> places_;
    bool is_carried_ = false;
};

/// Contents as JSON: base64 by names.
nlohmann::json carried_json(const NamedFiles::Contents& contents);
NamedFiles::Contents read_carried(const JsonValue& json);

} // namespace lockstep

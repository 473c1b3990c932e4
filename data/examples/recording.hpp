// Writes a recording for `lockstep check --trace` (docs/engines.md) with nothing but the standard library: collect the
// states while the engine runs, save() them in the end. C++17; little-endian machines.
#pragma once
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace recording {

using Floats = std::vector<float>;

/// "0.100000001", read back to the same bits.
inline std::string json(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", static_cast<double>(value));
    return text;
}

/// "[0.5, 1]"
inline std::string json(const float* values, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += (i == 0 ? "" : ", ") + json(values[i]);
    return "[" + text + "]";
}

/// FIPS 180-4, in hexadecimal digits.
inline std::string sha256(const std::string& content) {
    static const std::uint32_t round[64] = {
        0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
        0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
        0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
        0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
        0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
        0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
        0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
        0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
    std::array<std::uint32_t, 8> hash{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    const auto rotated = [](std::uint32_t x, int by) { return x >> by | x << (32 - by); };
    std::string end(1 + (119 - content.size() % 64) % 64, '\0');
    end[0] = static_cast<char>(0x80);
    for (int byte = 7; byte >= 0; --byte)
        end += static_cast<char>(std::uint64_t{content.size()} * 8 >> (8 * byte));
    const auto byte_at = [&](std::size_t i) {
        return std::uint32_t{static_cast<unsigned char>(i < content.size() ? content[i] : end[i - content.size()])};
    };
    for (std::size_t block = 0; block < content.size() + end.size(); block += 64) {
        std::uint32_t w[64];
        for (std::size_t i = 0; i < 16; ++i) {
            const std::size_t at = block + 4 * i;
            w[i] = byte_at(at) << 24U | byte_at(at + 1) << 16U | byte_at(at + 2) << 8U | byte_at(at + 3);
        }
        for (std::size_t i = 16; i < 64; ++i)
            w[i] = w[i - 16] + w[i - 7] + (rotated(w[i - 15], 7) ^ rotated(w[i - 15], 18) ^ w[i - 15] >> 3U) +
                   (rotated(w[i - 2], 17) ^ rotated(w[i - 2], 19) ^ w[i - 2] >> 10U);
        auto [a, b, c, d, e, f, g, h] = hash;
        for (std::size_t i = 0; i < 64; ++i) {
            const std::uint32_t t1 =
                h + (rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25)) + ((e & f) ^ (~e & g)) + round[i] + w[i];
            const std::uint32_t t2 = (rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
            h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
        }
        const std::array<std::uint32_t, 8> added{a, b, c, d, e, f, g, h};
        for (std::size_t i = 0; i < 8; ++i)
            hash[i] += added[i];
    }
    std::string digits;
    for (const std::uint32_t word : hash) {
        char text[9];
        std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(word));
        digits += text;
    }
    return digits;
}

/// An HDF5 file while it is made: objects one after the other, each after those that it names.
class Hdf5 {
  public:
    using Links = std::vector<std::pair<std::string, std::uint64_t>>;

    std::uint64_t floats(const std::vector<std::uint64_t>& extents, const Floats& values) {
        const char type[] = "\x11\x20\x1f\0\4\0\0\0\0\0\x20\0\x17\x08\0\x17\x7f\0\0\0"; // IEEE, 32 bits, little-endian
        return dataset(extents, {type, sizeof type - 1}, reinterpret_cast<const char*>(values.data()),
                       values.size() * sizeof(float));
    }

    std::uint64_t text(const std::string& text) {
        return dataset({}, std::string("\x13\x11\0\0", 4) + number(text.size(), 4), text.data(), text.size()); // UTF-8
    }

    /// `attribute`: an attribute's message, or none.
    std::uint64_t group(const Links& links, const std::string& attribute = "") {
        const std::uint64_t none = ~std::uint64_t{0};
        std::vector<std::string> messages{message(0x02, std::string(2, '\0') + number(none, 8) + number(none, 8)),
                                          message(0x0a, std::string(2, '\0'))};
        for (const auto& [name, address] : links)
            messages.push_back(
                message(0x06, std::string("\1\0", 2) + number(name.size(), 1) + name + number(address, 8)));
        if (!attribute.empty())
            messages.push_back(attribute);
        return header(messages);
    }

    /// An attribute `version` of two int32.
    static std::string version(std::uint64_t major, std::uint64_t minor) {
        return message(0x0c, std::string("\1\0\x08\0\x0c\0\x10\0version", 16) +
                                 std::string("\x10\x08\0\0\4\0\0\0\0\0\x20\0\0\0\0\0\1\1\0\0\0\0\0\0", 24) +
                                 number(2, 8) + number(major, 4) + number(minor, 4));
    }

    /// The whole content of the file after its first `before` bytes.
    std::string take(std::uint64_t root, std::uint64_t before) {
        const std::uint64_t none = ~std::uint64_t{0};
        const std::string head = std::string("\x89HDF\r\n\x1a\n\0\0\0\0\0\x08\x08\0\x04\0\x10\0\0\0\0\0", 24) +
                                 number(before, 8) + number(none, 8) + number(before + bytes_.size(), 8) +
                                 number(none, 8) + number(0, 8) + number(root, 8) + number(0, 24);
        return bytes_.replace(0, head.size(), head);
    }

  private:
    static std::string number(std::uint64_t value, std::size_t bytes) {
        std::string text(bytes, '\0');
        for (std::size_t i = 0; i < bytes && i < 8; ++i)
            text[i] = static_cast<char>(value >> 8 * i);
        return text;
    }

    static std::string message(std::uint64_t type, std::string body) {
        body.resize((body.size() + 7) / 8 * 8);
        return number(type, 2) + number(body.size(), 2) + number(0, 4) + body;
    }

    std::uint64_t append(const char* bytes, std::size_t count) {
        const std::uint64_t address = bytes_.size();
        bytes_.append(bytes, count);
        bytes_.resize((bytes_.size() + 7) / 8 * 8);
        return address;
    }

    std::uint64_t header(const std::vector<std::string>& messages) {
        std::string body;
        for (const std::string& one : messages)
            body += one;
        const std::string object =
            number(1, 2) + number(messages.size(), 2) + number(1, 4) + number(body.size(), 8) + body;
        return append(object.data(), object.size());
    }

    std::uint64_t dataset(const std::vector<std::uint64_t>& extents, const std::string& type, const char* values,
                          std::size_t bytes) {
        const std::uint64_t address = append(values, bytes);
        std::string space = number(1, 1) + number(extents.size(), 1) + number(0, 6);
        for (const std::uint64_t extent : extents)
            space += number(extent, 8);
        return header({message(0x01, space), message(0x03, type), message(0x05, std::string("\2\2\0\0", 4)),
                       message(0x08, std::string("\3\1", 2) + number(address, 8) + number(bytes, 8))});
    }

    std::string bytes_ = std::string(96, '\0'); ///< the superblock first
};

/// A run: the start, then the state after each frame.
class Recording {
  public:
    Recording(std::size_t particles, std::size_t width, std::size_t height)
        : particles_(particles), width_(width), height_(height) {}

    /// `velocity`: three floats a particle, like `position`.
    void state(const Floats& position, const Floats& velocity, const Floats& collide_time) {
        add(position, 3 * particles_, "position", position_);
        add(velocity, 3 * particles_, "velocity", velocity_);
        add(collide_time, particles_, "collide_time", collide_time_);
        ++rows_;
    }

    /// The collision detection texture after a frame, RGBA, as it lies in memory. None at all: the reference draws it.
    void image(const Floats& texels) { add(texels, 4 * width_ * height_, "image", image_); }

    /// What the passes of the next frame are given: the matrix that a position is multiplied by from the left, column
    /// after column, and the time step. `more`: further members of the frame, `"speed_factor": 0.5`.
    void frame(const float* proj_view, float tick, const std::string& more = "") {
        frames_ += (frames_.empty() ? "{\"proj_view\": " : ",\n {\"proj_view\": ") + json(proj_view, 16) +
                   ", \"constants\": {\"tick\": " + json(tick) + "}" + (more.empty() ? "" : ", " + more) + "}";
    }

    /// `scene`: a scene file's text (data/scenes/README.md) without emitters and frames.
    void save(const std::string& file, const std::string& scene) const {
        const std::size_t end = scene.rfind('}');
        if (end == std::string::npos || rows_ < 2)
            throw std::runtime_error(file + ": a recording has a scene, a start and at least one frame");
        const std::string with_frames = scene.substr(0, end) + ", \"frames\": [" + frames_ + "]}";
        Hdf5 hdf5;
        const auto value = [&](const std::vector<std::uint64_t>& extents, const Floats& values) {
            return hdf5.group({{"value", hdf5.floats(extents, values)}});
        };
        const std::uint64_t all = hdf5.group({{"collide_time", value({rows_, particles_}, collide_time_)},
                                              {"position", value({rows_, particles_, 3}, position_)},
                                              {"velocity", value({rows_, particles_, 3}, velocity_)}});
        const std::uint64_t parameters = hdf5.group({{"lockstep", hdf5.group({{"scene", hdf5.text(with_frames)}})}});
        Hdf5::Links root{{"h5md", hdf5.group({}, Hdf5::version(1, 1))},
                         {"parameters", parameters},
                         {"particles", hdf5.group({{"all", all}})}};
        if (!image_.empty())
            root.emplace_back("observables", hdf5.group({{"cdt", value({rows_ - 1, height_, width_, 4}, image_)}}));
        write(file, hdf5.take(hdf5.group(root), seal_bytes));
    }

  private:
    static constexpr std::size_t seal_bytes = 512;

    static void add(const Floats& values, std::size_t right, const char* what, Floats& all) {
        if (values.size() != right)
            throw std::runtime_error(std::string(what) + ": " + std::to_string(values.size()) + " floats; right is " +
                                     std::to_string(right));
        all.insert(all.end(), values.begin(), values.end());
    }

    static void write(const std::string& file, const std::string& content) {
        std::string seal = "lockstep trace 1\nbytes " + std::to_string(seal_bytes + content.size()) + "\nsha256 " +
                           sha256(content) + "\n";
        seal.resize(seal_bytes);
        std::ofstream stream(file, std::ios::binary);
        if (!(stream << seal << content).flush())
            throw std::runtime_error(file + ": cannot be written");
    }

    std::uint64_t particles_, width_, height_, rows_ = 0;
    Floats position_, velocity_, collide_time_, image_;
    std::string frames_;
};

} // namespace recording

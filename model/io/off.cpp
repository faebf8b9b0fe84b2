// OFF meshes (Geomview's, and what others made of it), line by line: OFF, COFF, NOFF, STOFF and their mixtures.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/input_file.h"
#include "model/io/mesh_readers.h"
#include "model/io/polygon_mesh.h"
#include "model/io/words.h"
#include "model/srgb.h"

namespace model {
namespace {

// What vertices have, by the letters before OFF.
struct Kind {
    bool uvs = false, colors = false, normals = false;
};

// None: the word is no such name.
std::optional<Kind> kind_of(std::string_view word) {
    if (!word.ends_with("OFF")) return std::nullopt;
    Kind kind;
    std::string_view letters = word.substr(0, word.size() - 3);
    const auto take = [&](std::string_view letter) {
        const bool there = letters.starts_with(letter);
        if (there) letters.remove_prefix(letter.size());
        return there;
    };
    kind.uvs = take("ST");
    kind.colors = take("C");
    kind.normals = take("N");
    if (!letters.empty()) fail(in_quotes(word), "OFF of three dimensions: OFF, COFF, NOFF, STOFF");
    return kind;
}

// Three or four numbers: fractions if any has a point or all are 0 and 1, else bytes. None: other counts, or what is
// no number.
std::optional<glm::u8vec4> color_of(Words words) {
    std::array<double, 4> values{};
    std::size_t count = 0;
    bool fractions = false;
    for (; count < values.size() && !words.at_end(); ++count) {
        const std::string_view word = words.next();
        values[count] = to_double_or_nan(word);
        fractions = fractions || word.find('.') != std::string_view::npos;
    }
    if (count < 3 || !words.at_end()) return std::nullopt;
    fractions = fractions || *std::max_element(values.begin(), values.end()) <= 1;
    glm::u8vec4 color(255);
    for (int i = 0; i < 3; ++i) {
        const double value = values[static_cast<std::size_t>(i)];
        if (!std::isfinite(value)) return std::nullopt;
        color[i] = unit_byte(static_cast<float>(fractions ? value : value / 255));
    }
    return color;
}

class OffReader {
public:
    OffReader(const std::filesystem::path& path, Warnings& warnings)
        : file_(path, "an OFF file", InputFile::Packing::unpacked), warnings_(warnings) {}

    Mesh read() {
        try {
            read_header();
            for (std::uint64_t i = 0; i < vertices_; ++i) read_vertex();
            for (std::uint64_t i = 0; i < faces_; ++i) read_face();
        } catch (const std::runtime_error& error) {
            const std::uint64_t line = std::max<std::uint64_t>(file_.line_number(), 1);
            throw std::runtime_error("line " + std::to_string(line) + ": " + error.what());
        }
        return mesh_.finish(warnings_);
    }

private:
    // The next line with anything but a comment.
    Words next_line() {
        std::string_view line;
        while (true) {
            if (!file_.line(line)) fail("the end of the file", "more data");
            Words words(line.substr(0, line.find('#')));
            if (!words.at_end()) return words;
        }
    }

    // The name may be missing, and the counts may follow it in its line.
    void read_header() {
        Words words = next_line(), counts = words;
        if (const auto kind = kind_of(words.next())) {
            kind_ = *kind;
            if (Words(words).next() == "BINARY") fail("a binary OFF file", "a text");
            counts = words.at_end() ? next_line() : words;
        }
        vertices_ = count_of(counts);
        faces_ = count_of(counts);
        if (vertices_ > most_corners) fail("more than 2^31 vertices", "fewer");
    }

    static std::uint64_t count_of(Words& words) {
        const std::int64_t count = to_integer(words.next());
        if (count < 0) fail("a count of " + std::to_string(count), "0 or more");
        return static_cast<std::uint64_t>(count);
    }

    // x y z [nx ny nz] [r g b [a]] [s t]; plain OFF may have colours, too.
    void read_vertex() {
        Words words = next_line();
        glm::dvec3 position;
        for (int i = 0; i < 3; ++i) position[i] = to_double(words.next());
        mesh_.positions.push_back(position);
        if (kind_.normals) {
            glm::vec3 normal;
            for (int i = 0; i < 3; ++i) normal[i] = static_cast<float>(to_double_or_nan(words.next()));
            mesh_.normals.push_back(normal);
        }
        if (kind_.uvs || words.at_end()) return add_color(std::nullopt);
        const auto color = color_of(words);
        if (!color) warnings_.add("vertex colour not understood, left white", words.rest());
        add_color(color);
    }

    void add_color(std::optional<glm::u8vec4> color) {
        if (color) mesh_.colors.resize(mesh_.positions.size() - 1, glm::u8vec4(255));
        if (color || !mesh_.colors.empty()) mesh_.colors.push_back(color.value_or(glm::u8vec4(255)));
    }

    // n corners, then a colour or none.
    void read_face() {
        Words words = next_line();
        corners_.clear();
        for (std::uint64_t left = count_of(words); left > 0; --left) {
            const std::int64_t vertex = to_integer(words.next());
            if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= vertices_)
                fail("vertex " + std::to_string(vertex), "0 to below " + std::to_string(vertices_));
            check_face_corners(corners_.size() + 1);
            corners_.push_back(static_cast<std::uint32_t>(vertex));
        }
        std::optional<glm::u8vec4> color;
        if (mesh_.colors.empty() && !words.at_end()) {
            color = color_of(words);
            if (!color) warnings_.add("face colour not understood, left white", words.rest());
        }
        mesh_.add_face({corners_, color, {}, no_texture});
    }

    InputFile file_;
    Warnings& warnings_;
    Kind kind_;
    std::uint64_t vertices_ = 0, faces_ = 0;
    std::vector<std::uint32_t> corners_;
    PolygonMesh mesh_{PolygonMesh::Looks::of_faces};
};

}  // namespace

Mesh read_off(const std::filesystem::path& path, Warnings& warnings) {
    return OffReader(path, warnings).read();
}

}  // namespace model

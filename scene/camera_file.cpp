// load_camera_path: a JSON file, distrusted.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "scene/camera_path.h"

namespace scene {

namespace {

using Json = nlohmann::json;

constexpr std::size_t max_bytes = 4 << 20, max_keys = 10'000;
constexpr double max_coordinate = 1e5;        // [m] beyond which nothing of the scene is a pixel
constexpr double max_time = 1e6;              // [s]
constexpr double min_fov = 1, max_fov = 170;  // [deg] exclusive

// Says what is wrong at which place of which file.
struct Reader {
    std::string file;

    [[noreturn]] void fail(const std::string& place, const std::string& found, const std::string& expected) const {
        throw std::runtime_error(file + ": " + (place.empty() ? "" : place + ": ") + "found " + found + ", expected " +
                                 expected);
    }

    // A value as it may be quoted in one short line.
    static std::string quote(const Json& value) {
        constexpr std::size_t longest = 40;
        std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
        if (text.size() > longest) text = text.substr(0, longest) + "...";
        return text;
    }

    // Members are known ones only: a misspelt name is not ignored.
    void check_members(const Json& object, const std::string& place,
                       std::initializer_list<std::string_view> known) const {
        std::string names;
        for (const std::string_view name : known) names += (names.empty() ? "" : ", ") + std::string(name);
        if (!object.is_object()) fail(place, quote(object), "an object with " + names);
        for (const auto& item : object.items()) {
            if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
                fail(place, "the member " + quote(Json(item.key())), names);
            }
        }
    }

    const Json& member(const Json& object, const char* name, const std::string& place) const {
        const auto found = object.find(name);
        if (found == object.end()) fail(place, "no member '" + std::string(name) + "'", "one");
        return *found;
    }

    double number(const Json& value, const std::string& place, double least, double most) const {
        const std::string range = "a number from " + text_of(least) + " to " + text_of(most);
        if (!value.is_number()) fail(place, quote(value), range);
        const double result = value.get<double>();
        if (!(result >= least && result <= most)) fail(place, quote(value), range);
        return result;
    }

    static std::string text_of(double value) {
        std::ostringstream out;
        out << value;
        return out.str();
    }

    // An optional member, false where it is missing.
    bool flag(const Json& object, const char* name, const std::string& place) const {
        const auto found = object.find(name);
        if (found == object.end()) return false;
        if (!found->is_boolean()) fail(place + name, quote(*found), "true or false");
        return found->get<bool>();
    }

    glm::dvec3 point(const Json& value, const std::string& place) const {
        if (!value.is_array() || value.size() != 3) fail(place, quote(value), "[x, y, z] in metres");
        glm::dvec3 result;
        for (int axis = 0; axis < 3; ++axis) {
            result[axis] = number(value[static_cast<std::size_t>(axis)], place, -max_coordinate, max_coordinate);
        }
        return result;
    }

    CameraKey key(const Json& value, const std::string& place) const {
        check_members(value, place, {"time_s", "position", "target", "fov_deg", "cut"});
        CameraKey key;
        key.time = number(member(value, "time_s", place), place + ".time_s", 0, max_time);
        key.pose.position = point(member(value, "position", place), place + ".position");
        key.pose.target = point(member(value, "target", place), place + ".target");
        if (key.pose.position == key.pose.target)
            fail(place + ".target", "the position's own " + quote(value["target"]), "another point, to look at");
        const Json& fov = member(value, "fov_deg", place);
        const double angle = number(fov, place + ".fov_deg", min_fov, max_fov);
        if (angle == min_fov || angle == max_fov) fail(place + ".fov_deg", quote(fov), "a number over 1 and below 170");
        key.pose.fov_y = angle * std::numbers::pi / 180;
        key.cut = flag(value, "cut", place + ".");
        return key;
    }

    std::vector<CameraKey> keys(const Json& list) const {
        if (!list.is_array() || list.empty() || list.size() > max_keys) {
            fail("keys", list.is_array() ? std::to_string(list.size()) + " keys" : quote(list),
                 "an array of 1 to " + std::to_string(max_keys) + " keys");
        }
        std::vector<CameraKey> result;
        for (const Json& item : list) {
            const std::string place = "keys[" + std::to_string(result.size()) + "]";
            const CameraKey next = key(item, place);
            if (!result.empty() && next.time <= result.back().time) {
                fail(place + ".time_s", text_of(next.time),
                     "more than the previous key's " + text_of(result.back().time));
            }
            if (result.empty() && next.cut) fail(place + ".cut", "true", "false: nothing is before the first key");
            result.push_back(next);
        }
        return result;
    }

    void check_seam(const CameraPath& path) const {
        const CameraPose &first = path.keys.front().pose, &last = path.keys.back().pose;
        if (path.keys.size() < 2) fail("keys", "1 key", "at least 2 in a closed path");
        if (first.position != last.position || first.target != last.target || first.fov_y != last.fov_y) {
            fail("keys", "a last key unlike the first", "equal position, target and fov_deg in a closed path");
        }
    }
};

std::string read_text(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        throw std::runtime_error(path.string() + ": found a folder, expected a camera path in JSON");
    }
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error(path.string() + ": can't be read, expected a camera path in JSON");
    std::string text(max_bytes + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes) {
        throw std::runtime_error(path.string() + ": found more than " + std::to_string(max_bytes) +
                                 " bytes, expected a camera path of at most that");
    }
    return text;
}

}  // namespace

CameraPath load_camera_path(const std::filesystem::path& path) {
    const Reader reader{path.string()};
    const std::string text = read_text(path);
    Json root;
    try {
        root = Json::parse(text);
    } catch (const Json::exception& error) {
        // Its message has the line and column, after a bracketed name.
        const std::string_view message = error.what();
        const std::size_t begin = message.find("] ");
        throw std::runtime_error(reader.file + ": found " +
                                 std::string(begin == message.npos ? message : message.substr(begin + 2)) +
                                 ", expected JSON");
    }
    reader.check_members(root, "", {"closed", "keys"});
    CameraPath result;
    result.closed = reader.flag(root, "closed", "");
    result.keys = reader.keys(reader.member(root, "keys", ""));
    if (result.closed) reader.check_seam(result);
    return result;
}

}  // namespace scene

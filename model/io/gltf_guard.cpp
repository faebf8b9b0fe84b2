#include "model/io/gltf_guard.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace model {
namespace {

using nlohmann::json;

constexpr int deepest = 64;
constexpr std::size_t most_objects = std::size_t{1} << 20;
constexpr std::size_t most_listed = std::size_t{1} << 17;            // in one of the top level's lists
constexpr std::uint64_t most_buffer_bytes = std::uint64_t{1} << 31;  // declared, over all buffers

// Walks the text once, without building a document (nlohmann's parser keeps its own stack on the heap).
class Guard : public nlohmann::json_sax<json> {
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }

    bool number_unsigned(number_unsigned_t value) override {
        if (!in_list("buffers") || key_ != "byteLength") return true;
        require(value <= most_buffer_bytes && (buffer_bytes_ += value) <= most_buffer_bytes,
                "buffers of more than 2 GiB", "less");
        return true;
    }

    bool start_object(std::size_t) override {
        descend();
        require(++objects_ <= most_objects, "more than " + std::to_string(most_objects) + " JSON objects", "fewer");
        if (depth_ != 3) return true;
        require(++listed_ <= most_listed, "more than " + std::to_string(most_listed) + " " + section_, "fewer");
        return true;
    }

    bool key(string_t& name) override {
        if (depth_ == 1) {
            section_ = name;
            listed_ = 0;
        }
        key_ = name;
        return true;
    }

    bool end_object() override {
        --depth_;
        return true;
    }

    bool start_array(std::size_t) override {
        descend();
        return true;
    }

    bool end_array() override {
        --depth_;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        throw std::runtime_error("found no valid JSON at byte " + std::to_string(position) +
                                 "; expected glTF 2.0's JSON");
    }

private:
    // Depth 1 is the document, 2 one of its lists, 3 an object in that list.
    bool in_list(const char* name) const { return depth_ == 3 && section_ == name; }

    void descend() {
        require(++depth_ <= deepest, "JSON nested more than " + std::to_string(deepest) + " deep", "plain glTF 2.0");
    }

    static void require(bool holds, const std::string& found, const std::string& expected) {
        if (!holds) throw std::runtime_error("found " + found + "; expected " + expected);
    }

    int depth_ = 0;
    std::size_t objects_ = 0, listed_ = 0;
    std::uint64_t buffer_bytes_ = 0;
    std::string section_, key_;
};

}  // namespace

void check_gltf_json(std::string_view text) {
    Guard guard;
    json::sax_parse(text.begin(), text.end(), &guard);
}

}  // namespace model

#include "sfsm/recordings/facts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "sfsm/number_text.h"
#include "sfsm/text.h"

namespace sfsm {
namespace {

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_letter_or_digit(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// "System RAM" and "SystemRam" are "systemram".
std::string plain_key(std::string_view key) {
    std::string plain;
    for (const char c : key) {
        if (is_letter_or_digit(c)) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return plain;
}

// "game.exe", also with arguments behind it; "24.0" is none.
bool is_file_name(std::string_view text) {
    const std::size_t dot = text.substr(0, text.find(' ')).rfind('.');
    if (dot == std::string_view::npos || dot == 0) return false;
    std::string_view extension = text.substr(dot + 1);
    extension = extension.substr(0, extension.find_first_of(" \"'"));
    constexpr std::size_t longest = 5;
    return !extension.empty() && extension.size() <= longest && is_letter(extension.front()) &&
           std::all_of(extension.begin(), extension.end(), is_letter_or_digit);
}

// Of folders, not of units ("3200 MT/s") or of drivers ("RTX 3080/PCIe/SSE2").
bool is_path(std::string_view text) {
    const std::size_t last = text.find_last_of("/\\");
    if (last == std::string_view::npos) return false;
    if (text.front() == '/' || text.front() == '~' || text.find("\\\\") != std::string_view::npos) return true;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
        const bool is_drive = text[i] == ':' && is_letter(text[i - 1]) && (text[i + 1] == '\\' || text[i + 1] == '/');
        if (is_drive) return true;
    }
    for (const std::string_view home : {"/home/", "/Users/", "\\Users\\"}) {
        if (text.find(home) != std::string_view::npos) return true;
    }
    return is_file_name(text.substr(last + 1));
}

bool says_nothing(std::string_view text) {
    for (const char* nothing : {"", "-", "unknown", "NA", "N/A", "none", "null", "not available"}) {
        if (same_name(text, nothing)) return true;
    }
    return false;
}

// Of MangoHud in KiB, of others with their unit.
std::string memory_text(const std::string& told) {
    const std::optional<std::int64_t> kib = parse_integer(told);
    constexpr double kib_per_gib = 1024 * 1024;
    if (!kib) return told;
    const auto gib = std::llround(static_cast<double>(*kib) / kib_per_gib);
    return gib > 0 ? std::to_string(gib) + " GB" : "";
}

class Teller {
public:
    explicit Teller(const std::map<std::string, std::string>& settings) {
        for (const auto& [key, value] : settings) by_key_.emplace(plain_key(key), presentable(value));
    }

    // The first that says something.
    std::string of(std::initializer_list<const char*> keys) const {
        for (const char* key : keys) {
            const auto found = by_key_.find(key);
            if (found != by_key_.end() && !found->second.empty()) return found->second;
        }
        return {};
    }

private:
    std::map<std::string, std::string> by_key_;
};

std::string or_else(const std::string& first, const std::string& second) {
    return first.empty() ? second : first;
}

std::string joined(const std::string& a, const char* between, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + between + b;
}

void add(Facts& facts, const char* name, const std::string& value) {
    if (!value.empty()) facts.emplace_back(name, value);
}

}  // namespace

std::string presentable(std::string_view value) {
    std::string_view text = without_blanks(value);
    if (is_path(text)) {
        text.remove_prefix(text.find_last_of("/\\") + 1);
        if (!is_file_name(text)) return {};
    }
    if (says_nothing(text)) return {};
    constexpr std::size_t longest = 120;
    std::string line(text.substr(0, longest));
    if (line.size() < text.size()) {
        while (!line.empty() && (static_cast<unsigned char>(text[line.size()]) & 0xc0) == 0x80) line.pop_back();
        line += "...";
    }
    std::replace_if(
        line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
    return line;
}

Facts facts_of(const Told& told) {
    const Teller file(told.settings);
    const std::string process = presentable(told.process);
    const std::string game = file.of({"gamename"});
    const std::string kernel = file.of({"kernel"});
    Facts facts;
    add(facts, "game", or_else(game, process));
    if (!game.empty() && !same_name(game, process)) add(facts, "process", process);
    add(facts, "GPU", file.of({"gpu", "desktopgpu"}));
    add(facts, "driver", file.of({"gpudriverversion", "driverpackage", "basedriverversion", "driver"}));
    add(facts, "CPU", file.of({"processor", "cpu"}));
    add(facts, "memory", memory_text(file.of({"systemram", "ram"})));
    add(facts, "system", joined(file.of({"os", "platform"}), ", ", kernel.empty() ? "" : "kernel " + kernel));
    add(facts, "API", or_else(presentable(told.runtime), file.of({"apiinfo"})));
    add(facts, "resolution", or_else(presentable(told.resolution), file.of({"resolutioninfo"})));
    add(facts, "present mode", or_else(presentable(told.present_mode), file.of({"presentationmode"})));
    add(facts, "recorder", joined(told.format, " ", file.of({"appversion"})));
    add(facts, "date", joined(file.of({"creationdate"}), " ", file.of({"creationtime"})));
    return facts;
}

Facts facts_of_trace(const std::map<std::string, std::string>& settings) {
    Facts facts;
    for (const char* key : {"law", "device", "people", "seed", "size", "draw"}) {
        const auto found = settings.find(key);
        if (found != settings.end()) add(facts, key, presentable(found->second));
    }
    return facts;
}

}  // namespace sfsm

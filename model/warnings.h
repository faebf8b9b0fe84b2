// What a file lost or had changed on its way in: what could be drawn was drawn, and what couldn't is said.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace model {

// One kind of loss, however often it came.
struct Warning {
    std::string what;   // "texture not found, left out": what was found, and what became of it
    std::string first;  // what the first was called: a name, a line; may be empty
    std::size_t count = 1;

    bool operator==(const Warning&) const = default;
};

// Kinds in the order in which they first came.
class Warnings {
public:
    // what: one of few texts, as each is a kind of its own. first: from the file; made printable and cut.
    void add(std::string_view what, std::string_view first);

    bool empty() const { return all_.empty(); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }

private:
    std::vector<Warning> all_;
};

// "texture not found, left out: 'gone.png', and 2 more".
std::string text_of(const Warning& warning);

}  // namespace model

// A line as words between blanks, and words as numbers, whatever the locale. Internal to the loaders.
#pragma once

#include <cstdint>
#include <string_view>

namespace model {

class Words {
public:
    explicit Words(std::string_view line) : rest_(line) {}

    // The next word; empty: there is none.
    std::string_view next() {
        skip_blanks();
        std::size_t size = 0;
        while (size < rest_.size() && !is_blank(rest_[size])) ++size;
        const std::string_view word = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return word;
    }

    bool at_end() {
        skip_blanks();
        return rest_.empty();
    }

    // All that is left, without blanks at both ends.
    std::string_view rest() {
        skip_blanks();
        while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
        return rest_;
    }

private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    }

    std::string_view rest_;
};

// The nearest double; what is too small for one is 0. NaN and infinity are numbers here, in C's and Microsoft's
// spelling (1.#IND), and so is what is too large. Throws std::runtime_error "found 'x'; expected a number".
double to_double(std::string_view word);

// to_double, but NaN for what is none: for what a mesh can do without.
double to_double_or_nan(std::string_view word);

// The nearest float; what is too small for one is 0. Throws std::runtime_error "found 'nan'; expected a finite number".
float to_float(std::string_view word);

// Throws std::runtime_error if it is none that 64 bits hold.
std::int64_t to_integer(std::string_view word);

}  // namespace model

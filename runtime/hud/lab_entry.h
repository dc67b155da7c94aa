#pragma once
#include "lab_quantities.h"
#include <string>
#include <string_view>

namespace starbow {

/// A student writes a reading of one instant down: the quantity by its number in a list, then the value, then its
/// uncertainty. The theory's value stays hidden until all is written.
class LabEntry {
public:
    explicit LabEntry(Measured at);

    /// Keys as they were typed: digits, point or comma, minus, '\b' to delete, '\n' for Enter, escape to give up.
    void type(std::string_view keys);

    bool open() const { return step_ != Step::done && step_ != Step::given_up; }
    /// The reading, once it is complete.
    std::optional<WrittenReading> written() const;
    const Measured& instant() const { return at_; }

    /// The lines that people see while they write.
    std::vector<std::string> lines(const Words& words) const;

private:
    enum class Step { quantity, value, uncertainty, done, given_up };
    void type_one(char key);
    void enter();

    Measured at_;
    std::vector<LabQuantity> offered_;
    Step step_ = Step::quantity;
    std::string typed_, value_text_; ///< as typed
    bool refused_ = false; ///< what was typed last is no number
    WrittenReading reading_;
};

/// The sentence about a complete reading, with the theory's value.
std::string says_of(const WrittenReading& reading, const Words& words);

/// The key that gives up.
constexpr char escape_character = '\x1b';

} // namespace starbow

#pragma once
#include "layout_loader.h"
#include "machine_files.h"
#include "runtime/machines/shared_state.h"

namespace starbow {

/// The layout of a node: that of its own file, with the numbers that a builder turns at the master.
class NodeLayout {
public:
    explicit NodeLayout(const ExhibitOptions& options);

    const Layout& kept() const { return kept_; } ///< the file's
    const Layout& shown() const { return shown_; }
    const ConfigMessage& config() const { return config_; } ///< for the master

    /// The master's files, which must be this node's. Numbers that the builder has kept in the master's file are kept in
    /// this one's, if that makes them equal. Throws InputError where the difference is not one of the layout, and before
    /// this node was ever in step.
    void compare(const ConfigMessage& master, bool was_in_step);

    /// The layout by a state's numbers, if it is another than the shown one. A layout of another name is loaded. Throws
    /// InputError where there is none of that name, or a number is none.
    std::optional<Layout> turned_by(const SharedState& shared);
    void turn(Layout layout, std::vector<TurnedNumber> numbers);
    /// True where the shown layout is the one of the state.
    bool is_of(const SharedState& shared) const { return shared.layout_digest == digest_ && shared.turned == numbers_; }

    LayoutLoader loader;
    /// A loaded layout that is shown from now on, without turned numbers: the next state has them.
    void take(LayoutLoader::Loaded loaded);

private:
    Layout kept_, shown_;
    std::vector<TurnedNumber> numbers_;
    ConfigMessage config_;
    std::uint64_t digest_;
    std::string named_; ///< by the last state
    std::optional<ConfigMessage> master_;
    std::string difference_; ///< the last one in the log
};

} // namespace starbow

#include "node_layout.h"
#include "config/model/shipped.h"
#include "runtime/operation/log.h"

namespace starbow {

NodeLayout::NodeLayout(const ExhibitOptions& options)
    : loader(options.layout)
    , kept_(options.layout)
    , shown_(options.layout)
    , config_(config_of(options, digests_of(options.layout)))
    , digest_(digest_of(config_.layout))
{
}

void NodeLayout::compare(const ConfigMessage& master, bool was_in_step)
{
    master_ = master;
    if (const std::string why = difference(config_, master); !why.empty())
        throw InputError(why);
    const std::string why = layout_difference(config_, master);
    const bool other_name
        = !master.layout.empty() && !config_.layout.empty() && master.layout.front().first != config_.layout.front().first;
    if (why.empty() || other_name) { // a state says where another layout is
        difference_.clear();
        return;
    }
    if (!was_in_step)
        throw InputError(why);
    try {
        if (const std::vector<Change> changes = changes_to_keep(config_, master, kept_, shown_); !changes.empty()) {
            patch_file(kept_.file, changes);
            write_log(LogKind::alignment_changed, "Saved in " + kept_.file.filename().string() + ", as in the master's");
            return; // the loader sees it
        }
    } catch (const InputError& error) {
        write_log(LogKind::layout_refused, one_line(error.what()) + "; the exhibit stays as it was");
    }
    if (std::exchange(difference_, why) != why)
        write_limited(LogKind::node_refused, why);
}

std::optional<Layout> NodeLayout::turned_by(const SharedState& shared)
{
    const bool other_name = std::exchange(named_, shared.layout) != shared.layout;
    if (shared.layout_digest != digest_) {
        if (other_name)
            loader.open(shipped_file("layouts", shared.layout));
        return {};
    }
    return shared.turned == numbers_ ? std::nullopt : std::optional(with_turned(kept_, shared.turned));
}

void NodeLayout::turn(Layout layout, std::vector<TurnedNumber> numbers)
{
    shown_ = std::move(layout), numbers_ = std::move(numbers);
}

void NodeLayout::take(LayoutLoader::Loaded loaded)
{
    kept_ = shown_ = std::move(loaded.fresh);
    numbers_.clear();
    config_.layout = std::move(loaded.digests);
    digest_ = digest_of(config_.layout);
    if (master_)
        compare(*master_, true);
}

} // namespace starbow

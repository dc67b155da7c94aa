#include "small_picture.h"

namespace starbow {

std::string thumbnail_of(const Command& command)
{
    switch (command.kind) {
    case CommandKind::scene:
        return "scene/" + command.text;
    case CommandKind::tour:
        return "tour/" + command.text;
    case CommandKind::shot:
        return "shot/" + command.text;
    default:
        return {};
    }
}

} // namespace starbow

#pragma once
#include "auth.h"
#include "config/model/programme_file.h"
#include "config/model/remote_file.h"
#include "input/command.h"
#include "snapshot.h"
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace starbow {

/// A command on its way to the exhibit.
struct NumberedCommand {
    std::uint64_t number = 0; ///< from 1, in the order of arrival
    Command command;
};

/// Everything that a remote starts with.
struct RemoteOptions {
    RemoteSettings settings;
    std::vector<std::string> patterns; ///< names of test patterns that the page offers
    std::optional<Programme> programme{}; ///< of a guide's show
    std::string version; ///< the program's
    /// Files of small pictures, PNG, by kind and name: "tour/rainbow". They may not be there yet.
    std::map<std::string, std::filesystem::path> thumbnails{};
};

/// Tablets, telephones, OSC and `starbow tell` steer the exhibit: one thread serves them all. take, answer and publish are
/// for the frame thread. They never wait, and what they allocate is the text of a command.
class Remote {
public:
    /// Begins to serve. An address or a port that this machine can't give is taken up once it can. Throws InputError for a
    /// wrong file.
    explicit Remote(RemoteOptions options);
    ~Remote();
    Remote(const Remote&) = delete;

    /// The PINs that were drawn, because no file of PINs exists; empty otherwise. They belong on the operator's window and
    /// never into the log.
    const Pins& drawn_pins() const;
    /// The page's address for a browser.
    const std::string& page() const;

    /// The next command, in the order of arrival; false: none. Each one that is taken is answered once.
    bool take(NumberedCommand& command);
    /// The command is applied and in the picture, or, with one sentence, refused.
    void answer(std::uint64_t number, const std::string& refusal = {});

    // The place to write, with an older value, and what makes it the newest one.
    Snapshot& next_snapshot();
    void publish_snapshot();
    Condition& next_condition();
    void publish_condition();
    LivePicture& next_picture();
    void publish_picture();
    /// A sentence about an address or a port that is still to come; empty: all are there.
    const std::string& lack();
    /// True if anybody looks at the live picture; otherwise none need be made.
    bool picture_wanted() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace starbow

#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace starbow {

enum class LogLevel : std::uint8_t { debug, info, warning, error };

/// The kinds of the log's lines. A text may change with the place and the moment, its kind's identifier never does:
/// scripts and the journal's catalog know the kinds by it. docs/operation.md explains each of them.
enum class LogKind : std::uint8_t {
    hung,
    usage_damaged,
    usage_unwritten,
    trace_ended,
    ends_unwritten,
    careful_start,
    alignment_changed,
    pattern_shown,
    world_note,
    level_no_room,
    memory_exceeded,
    inset_no_room,
    pipelines_made,
    pipelines_ready,
    pipelines_unsaved,
    output_smaller,
    output_shown,
    output_missing,
    window_too_large,
    layout_applied,
    layout_refused,
    gpu_lost,
    gpu_given_up,
    display_gone,
    command_taken,
    command_done,
    command_refused,
    command_failed,
    osc_refused,
    login,
    login_locked,
    remote_unencrypted,
    remote_key_open,
    remote_library,
    words_unreadable,
    files_used,
    device_plugged,
    device_unplugged,
    device_unreadable,
    device_trouble,
    device_well,
    tracker_wrong_packets,
    tracker_outside,
    record_ended,
    record_differs,
    lab_log_ended,
    lab_line_skipped,
    attraction_refused,
    speech_fails,
    node_joins,
    node_leaves,
    node_differs,
    node_doubled,
    node_refused,
    master_away,
    master_back,
    state_unread,
    network_routed,
    network_waits,
    network_opens,
    messages_refused,
    machines_library,
    master_second,
    screens_together,
    screens_apart,
};

struct LogRule {
    std::string_view name; ///< the journal's field STARBOW_LINE
    std::string_view message_id; ///< the journal's field MESSAGE_ID: 128 random bits, sd-id128(3)
    LogLevel level;
    std::string_view part; ///< the part of the program that speaks
};

/// One rule a kind, in the order of LogKind; packaging/catalog.py checks that the names are the same.
inline constexpr auto log_rules = std::to_array<LogRule>({
    {"hung", "ab027c2584c24366920d1b237173236d", LogLevel::error, "hang"},
    {"usage-damaged", "ff1a1f7c9d9a43789dba8c6cbcdd8392", LogLevel::warning, "usage"},
    {"usage-unwritten", "26322efe6f4f4cddb5135bec50098ac3", LogLevel::warning, "usage"},
    {"trace-ended", "565ce55dcb4743aaa47d10cb1f1da434", LogLevel::warning, "trace"},
    {"ends-unwritten", "2ac0711feb7f4047ac4e709a7ac609f5", LogLevel::warning, "exhibit"},
    {"careful-start", "674394c262ff49c8974a765ebab064e1", LogLevel::warning, "exhibit"},
    {"alignment-changed", "c47b19a394b24c3997578a3bc976ff50", LogLevel::info, "exhibit"},
    {"pattern-shown", "88fb6df0db614f5d8653bd181e56ec61", LogLevel::info, "exhibit"},
    {"world-note", "3403b4287e6a4c59a3db632aecb4d982", LogLevel::info, "world"},
    {"level-no-room", "ec6f6e48b8d8482cabf50517bf98aa76", LogLevel::warning, "quality"},
    {"memory-exceeded", "99833efd798f4047b9914e255908f32e", LogLevel::warning, "quality"},
    {"inset-no-room", "5a9b5b7c0ed44b44bfd8da56db0e28bb", LogLevel::warning, "quality"},
    {"pipelines-made", "91801205c29d4f9c9c97a58b511a0443", LogLevel::debug, "pipelines"},
    {"pipelines-ready", "cf796f9605b946c1bdb008bf7e219521", LogLevel::info, "pipelines"},
    {"pipelines-unsaved", "e0943825b19245fcabf8cef4011c46bc", LogLevel::debug, "pipelines"},
    {"output-smaller", "feecad33d7fa4938b205cb0c71001c5b", LogLevel::warning, "exhibit"},
    {"output-shown", "b29150238f9e410bb2b8c7d6295c06fd", LogLevel::info, "exhibit"},
    {"output-missing", "e6119f876843499ab5fff0e0f53e721e", LogLevel::warning, "exhibit"},
    {"window-too-large", "ad3bc9fddf494b0ebd647a463ad7d961", LogLevel::warning, "exhibit"},
    {"layout-applied", "fa67bb0dbe3e43d482d32bbd3adc814a", LogLevel::info, "layout"},
    {"layout-refused", "bebf7cef43ee49dcb9219eebbe42ca7b", LogLevel::warning, "layout"},
    {"gpu-lost", "84f60d62530a43ceb94df46dd11805f2", LogLevel::warning, "exhibit"},
    {"gpu-given-up", "70d94542f59c413aa4c04c73dcf7876e", LogLevel::error, "exhibit"},
    {"display-gone", "0a07890bd22d4949acfe039c4b22f207", LogLevel::error, "exhibit"},
    {"command-taken", "bf4293e84eae43cf9948c25e64ed166c", LogLevel::info, "remote"},
    {"command-done", "ad03d0e1ad7a453396172367a0a031be", LogLevel::debug, "remote"},
    {"command-refused", "ba59918a7fb64376abd5292be6773b43", LogLevel::info, "remote"},
    {"command-failed", "7824a70eb6324d59820ed64617468723", LogLevel::warning, "remote"},
    {"osc-refused", "f09284ce7b634fd481f50abd914a26e8", LogLevel::info, "remote"},
    {"login", "25ca2a1946fa4803baaeb462a019f32d", LogLevel::info, "remote"},
    {"login-locked", "ef46181bdbef41088e8ad1cc9348a8fe", LogLevel::warning, "remote"},
    {"remote-unencrypted", "0ab5023fbbef47b987efe71a562570b9", LogLevel::warning, "remote"},
    {"remote-key-open", "8a653a940b8e61f8b2e607414112ac03", LogLevel::warning, "remote"},
    {"remote-library", "c8e8957da82e423f81206f31dc202be0", LogLevel::debug, "remote"},
    {"words-unreadable", "c2c6acc7100b4ecb926ba9b9fae51429", LogLevel::warning, "remote"},
    {"files-used", "6ad2c698df584d9e801df4f06d8605b4", LogLevel::debug, "files"},
    {"device-plugged", "75e5d536cbe54472bcb909f0f4474874", LogLevel::info, "input"},
    {"device-unplugged", "65c785f902ac4dcd8386691360d48ebd", LogLevel::warning, "input"},
    {"device-unreadable", "97291daf15d24757a3b3709c71ecde3c", LogLevel::warning, "input"},
    {"device-trouble", "c5a9256fc66148989dcc56e9a6e990d5", LogLevel::warning, "input"},
    {"device-well", "1a3cc696dd4240949c8cfd4f7cb0989e", LogLevel::info, "input"},
    {"tracker-wrong-packets", "6869e3662e024793b691fc8b9174d9f2", LogLevel::warning, "input"},
    {"tracker-outside", "f1534a07dbe3455eab7ce3ac27ba93ce", LogLevel::warning, "input"},
    {"record-ended", "135d7259fca14b5dba915cafd04fec0b", LogLevel::warning, "record"},
    {"record-differs", "0919d1228f1b4405963596bb12e09c62", LogLevel::warning, "record"},
    {"lab-log-ended", "1623209b10c543b1956dc4cfd256c7cc", LogLevel::warning, "log"},
    {"lab-line-skipped", "d94e5b6f752842bbb85c59995a16581b", LogLevel::warning, "log"},
    {"attraction-refused", "672f0acf8a984782a9195c77537a2115", LogLevel::warning, "visit"},
    {"speech-fails", "b33d6d43979e40a1baec537d8cbd4e05", LogLevel::warning, "visit"},
    {"node-joins", "fb3adbe3a1a34c4d837f52357a2db02a", LogLevel::info, "machines"},
    {"node-leaves", "7fc5fbdddbba44c998e0512026898e3e", LogLevel::warning, "machines"},
    {"node-differs", "6a72b52c094f4e8a9616e6237b2f6d7e", LogLevel::warning, "machines"},
    {"node-doubled", "dd8c5e021c4943b795dbb3cb4dbbc2e0", LogLevel::warning, "machines"},
    {"node-refused", "54e8734a3d1d41bc8def8b7babcb50d3", LogLevel::warning, "machines"},
    {"master-away", "122a4a5423e6403c8a2bea4a568df604", LogLevel::warning, "machines"},
    {"master-back", "fb0dba00f73e4b138d9aa5918993361d", LogLevel::info, "machines"},
    {"state-unread", "ffe0a68e5a144419b59b8b4869dcb106", LogLevel::warning, "machines"},
    {"network-routed", "0033e635bb734a4abe0bdeddcabc27fe", LogLevel::warning, "machines"},
    {"network-waits", "42166162764aa3c1b68a6157f5feee79", LogLevel::warning, "network"},
    {"network-opens", "67512c430778aaf7dadf10262a8953a9", LogLevel::info, "network"},
    {"messages-refused", "b264668599f48c402959ee866a80a837", LogLevel::warning, "machines"},
    {"machines-library", "7e303b536836a2e502af179d0430508e", LogLevel::info, "machines"},
    {"master-second", "f2317dfaca37dd7b65ec292a8fbabf95", LogLevel::warning, "machines"},
    {"screens-together", "f01b21983ef75b6fd0b77e0b8fb291ba", LogLevel::info, "machines"},
    {"screens-apart", "b32a8c175c837d72531b389e0fe0862f", LogLevel::info, "machines"},
});

static_assert(log_rules.size() == std::size_t(LogKind::screens_apart) + 1);

constexpr const LogRule& rule_of(LogKind kind) { return log_rules[std::size_t(kind)]; }

/// Receives a line for the log. The rooms below the exhibit have one handed to them, and know no log.
using LogTo = std::function<void(LogKind, const std::string&)>;

} // namespace starbow

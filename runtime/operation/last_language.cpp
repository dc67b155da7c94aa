#include "last_language.h"
#include "config/json/error.h"
#include "config/json/whole_file.h"
#include <algorithm>
#include <system_error>
#include <thread>

namespace starbow {
namespace {

constexpr std::size_t most_name = 32;

bool is_name(const std::string& text)
{
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
    });
}

} // namespace

void keep_language(const std::filesystem::path& state, const std::string& language)
{
    if (state.empty() || !is_name(language))
        return;
    try {
        std::thread([file = state / "language", language] {
            try {
                write_own(file, language);
            } catch (const InputError&) { // a start after a crash then speaks the file's language
            }
        }).detach();
    } catch (const std::system_error&) { // no thread can be made now
    }
}

std::string kept_language(const std::filesystem::path& state)
{
    if (state.empty())
        return "";
    RegularFile file(state / "language");
    const std::string language = file.read_all(most_name);
    return !file.has_fault() && is_name(language) ? language : "";
}

void forget_language(const std::filesystem::path& state)
{
    std::error_code ignored;
    std::filesystem::remove(state / "language", ignored);
}

} // namespace starbow

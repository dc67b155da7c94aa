#include "patch.h"
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace starbow {
using nlohmann::json;

namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& pointer, const std::string& problem)
{
    throw InputError(file, one_line(pointer), problem);
}

bool is_finite_number(const json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

/// A number in a person's style: 3 rather than 3.0, and a space after a comma.
std::string written(const std::string& file, const std::string& pointer, const json& value)
{
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::abs(number) < 1e15)
            return std::to_string((long long)number);
    }
    if (is_finite_number(value) || value.is_boolean())
        return value.dump();
    if (value.is_string()) {
        try {
            return value.dump();
        } catch (const json::exception&) {
            refuse(file, pointer, "can't be set to a text that is not UTF-8; one in UTF-8 is right");
        }
    }
    if (!value.is_array() || !std::all_of(value.begin(), value.end(), is_finite_number))
        refuse(file, pointer,
            "can't be set to this; true or false, a finite number, a text or a list of finite numbers is right");
    std::string list;
    for (const json& number : value)
        list += (list.empty() ? "" : ", ") + written(file, pointer, number);
    return "[" + list + "]";
}

/// A pointer's steps, as names.
std::vector<std::string> steps(const std::string& file, const std::string& pointer)
{
    if (pointer.empty() || pointer[0] != '/')
        refuse(file, pointer, "leads to no member; a JSON pointer such as /outputs/0/size is right");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < pointer.size(); ++i) {
        if (pointer[i] == '/')
            names.emplace_back();
        else if (pointer[i] != '~')
            names.back() += pointer[i];
        else if (i + 1 < pointer.size() && (pointer[i + 1] == '0' || pointer[i + 1] == '1'))
            names.back() += pointer[++i] == '0' ? '~' : '/';
        else
            refuse(file, pointer, "holds a ~ that is neither ~0 nor ~1; a JSON pointer is right");
    }
    return names;
}

/// The place of a change: its innermost existing value and the missing objects on the way.
struct Target {
    std::string pointer; ///< of the innermost existing value
    std::vector<std::string> missing; ///< the steps beyond it
};

/// Follows the steps as far as they go, and sets the value in the document.
Target set(const std::string& file, json& root, const Change& change)
{
    Target target;
    json* at = &root;
    for (const std::string& name : steps(file, change.pointer)) {
        if (!target.missing.empty()) {
            target.missing.push_back(name);
            at = &(*at = json::object())[name];
            continue;
        }
        const std::string next = target.pointer + "/" + escaped(name);
        if (at->is_array()) {
            const bool counted = !name.empty() && name.size() < 9 && (name[0] != '0' || name.size() == 1)
                && std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
            if (!counted || std::stoul(name) >= at->size())
                refuse(file, change.pointer,
                    "leads beyond the " + std::to_string(at->size()) + " elements of " + target.pointer
                        + "; the number of one that is there is right");
            at = &(*at)[std::stoul(name)];
            target.pointer = next;
        } else if (!at->is_object()) {
            refuse(file, change.pointer,
                "leads through " + target.pointer + ", which has no members; an object in { } is right there");
        } else if (at->contains(name)) {
            at = &(*at)[name];
            target.pointer = next;
        } else {
            target.missing.push_back(name);
            at = &(*at)[name];
        }
    }
    if (target.missing.empty() && at->is_object())
        refuse(file, change.pointer, "is an object, which a single value would replace; one of its members is right");
    if (target.missing.empty() && at->is_array()
        && std::any_of(at->begin(), at->end(), [](const json& element) { return element.is_object(); }))
        refuse(
            file, change.pointer, "is a list of objects, which a single value would replace; one of their members is right");
    *at = change.value;
    return target;
}

/// The text with a member after the opening brace, on a line of its own if the first member has one.
std::string with_member(const std::string& text, const Span& object, const std::string& member)
{
    if (!object.first_key) {
        const bool tight = text[object.begin + 1] == '}';
        return text.substr(0, object.begin + 1) + " " + member + (tight ? " " : "") + text.substr(object.begin + 1);
    }
    const std::size_t line_end = text.find('\n', object.begin), key = *object.first_key;
    if (line_end < key) {
        std::string_view rest(text.data() + object.begin + 1, line_end - object.begin - 1);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r"), rest.size()));
        const std::size_t key_line = text.rfind('\n', key) + 1;
        const std::string indent = text.substr(key_line, key - key_line);
        if ((rest.empty() || rest.starts_with("//")) && indent.find_first_not_of(" \t") == indent.npos) {
            const std::string newline = text[line_end - 1] == '\r' ? "\r\n" : "\n";
            return text.substr(0, line_end + 1) + indent + member + "," + newline + text.substr(line_end + 1);
        }
    }
    return text.substr(0, object.begin + 1) + " " + member + "," + text.substr(object.begin + 1);
}

/// Writes a new file with the old one's permissions and renames it; errno gives the reason of a failure.
bool write_and_rename(const std::filesystem::path& file, const std::string& text, const struct stat& old)
{
    std::string name = file.string() + ".XXXXXX";
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0)
        return false;
    // The owner is kept where the system allows it: root may have changed a visitor's file.
    bool good = fchown(descriptor, old.st_uid, old.st_gid) == 0 || errno == EPERM;
    good = good && fchmod(descriptor, old.st_mode & 07777) == 0;
    for (std::size_t done = 0; good && done < text.size();) {
        const ssize_t count = write(descriptor, text.data() + done, text.size() - done);
        good = count > 0 || (count < 0 && errno == EINTR);
        done += std::size_t(std::max<ssize_t>(count, 0));
    }
    good = good && fsync(descriptor) == 0;
    int fault = errno;
    if (close(descriptor) != 0 && good) {
        good = false;
        fault = errno;
    }
    if (good && rename(name.c_str(), file.c_str()) != 0) {
        good = false;
        fault = errno;
    }
    if (!good) {
        unlink(name.c_str());
        errno = fault;
    }
    return good;
}

} // namespace

std::string patched(const std::string& file, const std::string& text, const Change& change)
{
    const std::string value = written(file, change.pointer, change.value);
    const Document document = parse_document(file, text);
    json expected = document.root;
    const Target target = set(file, expected, change);
    if (expected == document.root)
        return text;

    std::string result = text;
    const Place at{&document, &document.root.at(json::json_pointer(target.pointer)), target.pointer};
    if (!target.missing.empty()) {
        std::string member = value;
        for (auto name = target.missing.rbegin(); name != target.missing.rend(); ++name)
            member = written(file, change.pointer, *name) + ": "
                + (name == target.missing.rbegin() ? member : "{ " + member + " }");
        result = with_member(text, find_span(document, target.pointer).value(), member);
    } else if (at.json->is_array() && change.value.is_array() && at.json->size() == change.value.size()) {
        for (std::size_t i = 0; i < change.value.size(); ++i)
            result = patched(file, result, {target.pointer + "/" + std::to_string(i), change.value[i]});
    } else {
        const Span span = find_span(document, target.pointer).value();
        result.replace(span.begin, span.end - span.begin, value);
    }
    if (parse_document(file, result).root != expected)
        refuse(file, change.pointer, "can't be set without changing more of the file; setting it by hand is right");
    return result;
}

void patch_file(const std::filesystem::path& path, const std::vector<Change>& changes)
{
    const Document document = read_document(path);
    std::string text = document.text;
    for (const Change& change : changes)
        text = patched(document.file, text, change);
    if (text == document.text)
        return;
    // A link stays a link; its target is changed.
    std::error_code error;
    const std::filesystem::path file = std::filesystem::canonical(path, error);
    struct stat old;
    if (error || stat(file.c_str(), &old) != 0 || !S_ISREG(old.st_mode) || access(file.c_str(), W_OK) != 0
        || !write_and_rename(file, text, old))
        throw InputError(document.file, "",
            std::string("can't be written (") + (error ? error.message() : std::strerror(errno))
                + "); a file and folder that this user may write to is right");
}

} // namespace starbow

#pragma once
#include <string>

namespace starbow {

/// A label's value: backslash, quotation mark and a line's end are escaped.
std::string escaped_label(const std::string& value);

/// Writes metrics in Prometheus's text format, version 0.0.4, each name after "starbow_".
class Exposition {
public:
    explicit Exposition(std::string before = {})
        : text(std::move(before))
    {
    }
    /// The lines before a metric's values. kind: counter, gauge or histogram.
    void metric(const char* name, const char* kind, const char* help);
    void value(const std::string& name, double value);
    /// A metric of one value.
    void one(const char* name, const char* kind, const char* help, double number);

    std::string text;
};

} // namespace starbow

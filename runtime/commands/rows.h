#pragma once
#include <chrono>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace starbow {

/// Shows the progress of a picture on a terminal, with an estimate of the rest.
class Rows {
public:
    explicit Rows(const std::string& output)
        : output_(output)
    {
    }
    ~Rows()
    {
        if (shown_)
            std::fprintf(stderr, "\r%70s\r", "");
    }
    void show(int done, int rows)
    {
        using namespace std::chrono;
        const auto now = steady_clock::now();
        if (first_ == 0)
            first_ = done, began_ = now;
        if (!isatty(STDERR_FILENO) || now - last_ < std::chrono::milliseconds(200))
            return;
        last_ = now, shown_ = true;
        std::fprintf(stderr, "\r%-30.30s %d of %d rows", output_.c_str(), done, rows);
        if (done > first_)
            std::fprintf(
                stderr, ", about %.0f s left ", duration<double>(now - began_).count() / (done - first_) * (rows - done));
        std::fflush(stderr);
    }

private:
    std::string output_;
    int first_ = 0;
    bool shown_ = false;
    std::chrono::steady_clock::time_point began_, last_;
};

} // namespace starbow

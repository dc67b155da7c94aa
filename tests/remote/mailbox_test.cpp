// The mailbox and the triple buffer between the frame thread and the server, with both threads at work.
#include "runtime/remote/mailbox.h"
#include "runtime/remote/triple_buffer.h"
#include "tests/support/files.h"
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <vector>

namespace mailbox_test {

using namespace starbow;

TEST(Mailbox, AFullOneRefusesAndKeepsTheLetter)
{
    Mailbox<std::unique_ptr<int>, 4> box;
    for (int i = 0; i < 4; ++i)
        EXPECT_TRUE(box.put(std::make_unique<int>(i)));
    auto fifth = std::make_unique<int>(4);
    EXPECT_FALSE(box.put(std::move(fifth)));
    ASSERT_TRUE(fifth);
    EXPECT_EQ(box.refused(), 1u);
    std::unique_ptr<int> letter;
    for (int round = 0; round < 1000; ++round) { // many times around the ring
        ASSERT_TRUE(box.take(letter));
        EXPECT_EQ(*letter, round % 5);
        EXPECT_TRUE(box.put(std::make_unique<int>((round + 4) % 5)));
    }
    EXPECT_EQ(box.refused(), 1u);
}

TEST(Mailbox, AllLettersArriveInOrderBetweenTwoThreads)
{
    const int count
        = starbow::testing::all_cases() ? 200'000 : 20'000; // each waits for the other thread, on a busy machine for long
    Mailbox<std::vector<int>, 8> box; // with memory of its own, so that a sanitizer sees a letter that is read too early
    std::size_t refused = 0;
    std::thread putter([&] {
        for (int i = 0; i < count; ++i)
            for (std::vector<int> letter{i, -i}; !box.put(std::move(letter)); std::this_thread::yield())
                ++refused;
    });
    std::vector<int> letter;
    for (int next = 0; next < count; ++next) {
        while (!box.take(letter))
            std::this_thread::yield();
        ASSERT_EQ(letter, (std::vector<int>{next, -next}));
    }
    putter.join();
    EXPECT_FALSE(box.take(letter));
    EXPECT_EQ(box.refused(), refused);
}

TEST(TripleBuffer, TheNewestValueIsReadOnceAndStays)
{
    TripleBuffer<int> buffer;
    EXPECT_FALSE(buffer.refresh());
    for (int i = 1; i <= 5; ++i) {
        buffer.next() = i;
        buffer.publish();
    }
    EXPECT_TRUE(buffer.refresh());
    EXPECT_EQ(buffer.newest(), 5);
    buffer.next() = 6; // not yet published
    EXPECT_FALSE(buffer.refresh());
    EXPECT_EQ(buffer.newest(), 5);
    buffer.publish();
    buffer.next() = 7;
    EXPECT_TRUE(buffer.refresh());
    EXPECT_EQ(buffer.newest(), 6);
}

TEST(TripleBuffer, NoValueIsTornAndNoneComesBackBetweenTwoThreads)
{
    constexpr int count = 300000, words = 64;
    TripleBuffer<std::vector<int>> buffer;
    std::thread writer([&] {
        for (int i = 1; i <= count; ++i) {
            buffer.next().assign(words, i);
            buffer.publish();
        }
    });
    int last = 0;
    while (last < count) {
        if (!buffer.refresh()) {
            std::this_thread::yield();
            continue;
        }
        const std::vector<int>& value = buffer.newest();
        ASSERT_EQ(value.size(), std::size_t(words));
        ASSERT_GT(value.front(), last);
        for (const int word : value)
            ASSERT_EQ(word, value.front());
        last = value.front();
    }
    writer.join();
    EXPECT_FALSE(buffer.refresh());
}

} // namespace mailbox_test

"""The worksheet's theory by school formulas, for the scripts beside this file. It shares no code with the program."""
import math

GAMMA_4 = math.sqrt(15) / 4  # the speed at gamma 4, c = 1
PAST = 31 / math.sqrt(3)  # how far the ship has flown past the middle clock at 0.5 c when it is seen abeam, light-seconds


def doppler(beta, degrees):
    """D of light that is seen so far from the motion."""
    return math.sqrt(1 - beta * beta) / (1 - beta * math.cos(math.radians(degrees)))


def seen(beta, degrees):
    """Aberration: the seen angle of light from an angle in the world."""
    c = math.cos(math.radians(degrees))
    return math.degrees(math.acos((c + beta) / (1 + beta * c)))


def world_angle(x):
    """The angle between the motion and the clock at x, from the place of clocks-passing."""
    return math.degrees(math.atan2(31, x - PAST))


def passing(x):
    """A clock's reading from that place, when the middle one shows 0."""
    return math.hypot(PAST, 31) - math.hypot(PAST - x, 31)


def at_rest(x):
    return 31 - math.hypot(x, 31)


THEORY = {
    "A1": 2 * math.degrees(math.atan(10 / 31)),
    "A2": seen(0.5, world_angle(-10)) - seen(0.5, world_angle(10)),
    "A3": world_angle(-10) - world_angle(10),
    "D1": doppler(GAMMA_4, 0),
    "D2": doppler(GAMMA_4, 90),
    "D7": doppler(0.5, 90),
    "D8": 550 / doppler(0.5, 90),
    "C1": at_rest(-10),
    "C3": passing(-10),
    "C6": passing(10),
    "T2": 31,
    "L3": 20,
    "H1": doppler(GAMMA_4, 60) ** 3,
}

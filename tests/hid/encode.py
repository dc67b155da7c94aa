#!/usr/bin/python3
"""Writes report descriptors and input reports from the fields of this folder's files (README.md says what each key means).

    encode.py FILE...           writes `descriptor_hex`, `descriptor_bytes` and the `hex` of reports that have `values`
    encode.py --check FILE...   changes nothing; fails if a file holds other bytes than this program would write

The descriptor of a file with `items` is the bytes at the front of its items. That of a file with `"encoded": true` is made here, in one
order for every device. Each run of like fields states all its global items anew:

    report size, report count, logical minimum, logical maximum, usage page, usages, input

and each gap between fields becomes constant bits. The input reports of one application collection follow each other by number.
A file with neither key holds bytes by others, which stay as they are.
"""
import json
import sys

# Prefixes of HID 1.11, 6.2.2.4 to 6.2.2.8, with a size of 0.
INPUT, COLLECTION, END_COLLECTION = 0x80, 0xA0, 0xC0
USAGE_PAGE, LOGICAL_MINIMUM, LOGICAL_MAXIMUM, REPORT_SIZE, REPORT_ID, REPORT_COUNT = 0x04, 0x14, 0x24, 0x74, 0x84, 0x94
USAGE, USAGE_MINIMUM, USAGE_MAXIMUM = 0x08, 0x18, 0x28
CONSTANT, VARIABLE, RELATIVE, NULL_STATE, APPLICATION = 1, 2, 4, 64, 1


def item(prefix, number, signed=False):
    """A short item in the fewest bytes that hold its number. Logical limits are signed for every reader but the oldest."""
    for code, size in ((1, 1), (2, 2), (3, 4)):
        low, high = (-(1 << 8 * size - 1), 1 << 8 * size - 1) if signed else (0, 1 << 8 * size)
        if low <= number < high:
            return bytes([prefix | code]) + number.to_bytes(size, "little", signed=signed)
    raise ValueError(f"{number} has no room in four bytes")


def likeness(field):
    """Fields with equal likeness can stand in one input item."""
    return (field["bits"], field["logical_min"], field["logical_max"], field["null_state"], field.get("relative", False),
            field["usage_page"], str(field.get("array_usages")))


def runs(fields):
    """Fields in the order of their bits, cut where bits are left out, the likeness changes, or a repeated usage has ended."""
    all_runs = []
    for field in sorted(fields, key=lambda f: f["bit_offset"]):
        last = all_runs[-1][-1] if all_runs else None
        if (last and last["bit_offset"] + last["bits"] == field["bit_offset"] and likeness(last) == likeness(field)
                and (field.get("repeated_usage") or not last.get("repeated_usage"))):
            all_runs[-1].append(field)
        elif field.get("repeated_usage"):
            raise ValueError(f"nothing before the field at bit {field['bit_offset']} has the usage that it repeats")
        else:
            all_runs.append([field])
    return all_runs


def usages(run):
    """Ranges of usages that follow each other, and single usages."""
    if "array_usages" in run[0]:
        ranges = [(first, last) for page, first, last in run[0]["array_usages"]]
    else:
        ranges = []
        for usage in (f["usage"] for f in run if not f.get("repeated_usage")):
            if ranges and ranges[-1][1] + 1 == usage:
                ranges[-1] = (ranges[-1][0], usage)
            else:
                ranges.append((usage, usage))
    return b"".join(item(USAGE, first) if first == last else item(USAGE_MINIMUM, first) + item(USAGE_MAXIMUM, last)
                    for first, last in ranges)


def encoded_report(fields, bits):
    out, at = b"", 0

    def skip(to):
        return item(REPORT_SIZE, 1) + item(REPORT_COUNT, to - at) + item(INPUT, CONSTANT | VARIABLE) if to > at else b""

    for run in runs(fields):
        first, count = run[0], len(run)
        if first["bit_offset"] < at:
            raise ValueError(f"the field at bit {first['bit_offset']} begins inside another one")
        out += skip(first["bit_offset"])
        flags = ((0 if "array_usages" in first else VARIABLE) | (RELATIVE if first.get("relative") else 0)
                 | (NULL_STATE if first["null_state"] else 0))
        out += (item(REPORT_SIZE, first["bits"]) + item(REPORT_COUNT, count)
                + item(LOGICAL_MINIMUM, first["logical_min"], True) + item(LOGICAL_MAXIMUM, first["logical_max"], True)
                + item(USAGE_PAGE, first["usage_page"]) + usages(run) + item(INPUT, flags))
        at = first["bit_offset"] + count * first["bits"]
    return out + skip(bits)


def encoded_descriptor(device):
    """With as many application collections as input reports each has one report; else the first has all."""
    reports = sorted((int(number), bits) for number, bits in device["input_report_bits"].items())
    applications = device["application_usages"]
    alone = len(applications) == len(reports)
    out = b""
    for i, (page, usage) in enumerate(applications):
        out += item(USAGE_PAGE, page) + item(USAGE, usage) + item(COLLECTION, APPLICATION)
        for number, bits in [reports[i]] if alone else reports if i == 0 else []:
            if device["uses_report_ids"]:
                out += item(REPORT_ID, number)
            out += encoded_report([f for f in device["fields"] if f["report_id"] == number], bits)
        out += bytes([END_COLLECTION])
    return out


def named_fields(device, number):
    """The fields of a report by the names that `values` gives them: PAGE/USAGE, then PAGE/USAGE/2 for its second value."""
    found = {}
    for field in device["fields"]:
        if field["report_id"] == number:
            name = f"{field['usage_page']}/{field['usage']}"
            count = 1 + sum(1 for other in found if other == name or other.startswith(name + "/"))
            found[name if count == 1 else f"{name}/{count}"] = field
    return found


def encoded_input(device, report):
    number = report.get("report_id", 0)
    fields, whole = named_fields(device, number), 0
    for name, value in report["values"].items():
        field = fields[name]
        whole |= (value & (1 << field["bits"]) - 1) << field["bit_offset"]
    payload = whole.to_bytes(device["input_report_bits"][str(number)] // 8, "little")
    return (bytes([number]) if device["uses_report_ids"] else b"") + payload


def completed(device):
    out = dict(device)
    if "items" in device:
        out["descriptor_hex"] = "".join(line.split("  ")[0].replace(" ", "") for line in device["items"])
    elif device.get("encoded"):
        out["descriptor_hex"] = encoded_descriptor(device).hex()
    out["descriptor_bytes"] = len(out["descriptor_hex"]) // 2
    out["reports"] = [{**report, "hex": encoded_input(device, report).hex()} if "values" in report else report
                      for report in device.get("reports", [])]
    return out


def text(device):
    """JSON with one line for each key, report, item and field."""
    lines = []
    for key, value in device.items():
        if key in ("reports", "fields", "items") and value:
            lines.append(f" {json.dumps(key)}: [\n" + ",\n".join("  " + json.dumps(one) for one in value) + "\n ]")
        else:
            lines.append(f" {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def main():
    check = sys.argv[1:2] == ["--check"]
    wrong = 0
    for name in sys.argv[1 + check:]:
        with open(name, encoding="utf-8") as file:
            before = file.read()
        device = json.loads(before)
        after = completed(device)
        if check and after != device:
            print(f"{name}: its bytes are not those that encode.py makes of its fields")
            wrong = 1
        elif not check and text(after) != before:
            with open(name, "w", encoding="utf-8") as file:
                file.write(text(after))
    return wrong


if __name__ == "__main__":
    sys.exit(main())

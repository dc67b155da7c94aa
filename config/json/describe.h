#pragma once
#include "reader.h"
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <variant>

namespace starbow {

// A struct that a file can hold is described once: a name, a form, a meaning and its members for each value of the file. Its
// reader, its writer and its JSON schema follow from that. A form is how one value stands in a file. It has
//
// - read(const Place&, const Folder&), which returns the value, or throws InputError for a wrong one. A form that sets
//   several members has read_into(const Place&, Owner&, const Folder&) instead. The form of a value that `check` reads has
//   neither.
// - written(const Value&), the value as the file has it. A kind of file that is only read does not need it.
// - schema(Json& definitions), the JSON schema of the value without its meaning and its default. A kind of file that
//   only the program writes does not need it.
//
// Rules between members are a function check(const Place&, Owner&, const Folder&), and `rules` in the schema. Rules of the
// members' presence alone may be check_members(const Place&, const Owner*), which is called before values are read.

using Json = nlohmann::ordered_json;
/// The folder from which a file's paths start. A kind of file whose forms need more derives from it.
struct Folder {
    std::filesystem::path path;
    Folder(std::filesystem::path start = {})
        : path(std::move(start))
    {
    }
};

namespace described {

/// Constants of several types. A std::tuple of the fields took a fifth of all compilation of what reads files.
template <std::size_t, class T> struct Cell {
    T value;
};
template <class Numbers, class... T> struct Cells;
template <std::size_t... i, class... T> struct Cells<std::index_sequence<i...>, T...> : Cell<i, T>... {
    template <class Visit> constexpr void each(Visit&& visit) const
    {
        (visit(static_cast<const Cell<i, T>&>(*this).value), ...);
    }
    template <class Function> constexpr decltype(auto) all(Function&& function) const
    {
        return function(static_cast<const Cell<i, T>&>(*this).value...);
    }
};
template <class... T> using Row = Cells<std::index_sequence_for<T...>, T...>;
template <class T> constexpr const T& first(const Cell<0, T>& cell) { return cell.value; }

} // namespace described

/// One value of a file. Members: none for a value that another field's form reads, too.
template <class Form, class Owner, class... Values> struct Field {
    const char* name;
    Form form;
    const char* says; ///< its meaning, with its unit
    bool is_needed;
    described::Row<Values Owner::*...> members;
    static constexpr bool is_again = false;
};
/// A value that may be left out.
template <class Form, class Owner, class... Values>
constexpr auto field(const char* name, Form form, const char* says, Values Owner::*... members)
{
    return Field<Form, Owner, Values...>{name, form, says, false, {{members}...}};
}
template <class Form, class Owner, class... Values>
constexpr auto needed(const char* name, Form form, const char* says, Values Owner::*... members)
{
    return Field<Form, Owner, Values...>{name, form, says, true, {{members}...}};
}
/// A value that makes members which another field makes, too, or none: `check` reads it.
template <class Form, class Owner, class... Values> struct Again : Field<Form, Owner, Values...> {
};
template <class Form, class Owner, class... Values>
constexpr auto again(const char* name, Form form, const char* says, Values Owner::*... members)
{
    return Again<Form, Owner, Values...>{{name, form, says, false, {{members}...}}};
}
/// Members of a struct that its file does not hold.
template <class Owner, class... Values> struct NotInFile {
};
template <class Owner, class... Values> constexpr NotInFile<Owner, Values...> not_in_file(Values Owner::*...) { return {}; }

/// The description of a struct; `name`: of its kind, of a tagged alternative its "type".
template <class Owner, class... Fields> struct Description {
    using Struct = Owner;
    const char* name;
    const char* says;
    described::Row<Fields...> fields;
    const char* rules = "{}"; ///< JSON: what the schema says beside its members
    bool is_file = false; ///< it may name its schema
};
template <class Owner, class... Fields> constexpr auto describe(const char* name, const char* says, Fields... fields)
{
    return Description<Owner, Fields...>{name, says, {{fields}...}};
}
template <class Owner, class... Fields> constexpr auto describe_file(const char* name, const char* says, Fields... fields)
{
    return Description<Owner, Fields...>{name, says, {{fields}...}, "{}", true};
}
namespace described {

template <class Field> constexpr auto in_file(const Field& field) { return std::tuple{field}; }
template <class Owner, class... Values> constexpr std::tuple<> in_file(const NotInFile<Owner, Values...>&) { return {}; }

} // namespace described
/// The same with more fields, which hold the members that the former does not.
template <class Owner, class... Fields, class... More>
constexpr auto with_fields(const Description<Owner, Fields...>& description, More... more)
{
    return std::apply(
        [&]<class... All>(const All&... all) {
            return Description<Owner, All...>{
                description.name, description.says, {{all}...}, description.rules, description.is_file};
        },
        description.fields.all(
            [&](const Fields&... fields) { return std::tuple_cat(described::in_file(fields)..., std::tuple{more...}); }));
}
template <class Description> constexpr Description with_rules(Description description, const char* rules)
{
    description.rules = rules;
    return description;
}

/// The form of a number.
struct Number {
    Range range;
    double step = 0; ///< above 0: the alignment keys change it by so much, under this name for people
    const char* turned = "";
    double read(const Place& place, const Folder&) const { return number(place, range); }
    Json written(double value) const { return value; }
    Json schema(Json&) const;
};

/// A specialization for each struct of a file.
template <class T> inline constexpr auto description = nullptr;
template <class T>
concept Described = !std::is_null_pointer_v<std::remove_const_t<decltype(description<T>)>>;

namespace described {

struct Anything {
    template <class T> operator T() const;
};
/// True if an aggregate has at least so many members.
template <class T, std::size_t... i> consteval bool takes(std::index_sequence<i...>)
{
    return requires { T{(void(i), Anything{})...}; };
}
template <class Form, class Owner, class... Values> consteval std::size_t covered(const Field<Form, Owner, Values...>*)
{
    return sizeof...(Values);
}
template <class Form, class Owner, class... Values> consteval std::size_t covered(const Again<Form, Owner, Values...>*)
{
    return 0;
}
template <class Owner, class... Values> consteval std::size_t covered(const NotInFile<Owner, Values...>*)
{
    return sizeof...(Values);
}
template <class Owner, class... Fields> consteval std::size_t all_covered(const Description<Owner, Fields...>*)
{
    return (covered(static_cast<const Fields*>(nullptr)) + ... + 0);
}

/// Calls visit with each field of a struct.
template <class T, class Visit> void for_each_field(Visit&& visit)
{
    description<T>.fields.each([&](const auto& one) {
        if constexpr (requires { one.form; })
            visit(one);
    });
}

/// An object's members one after the other. It is no template: there are hundreds of fields.
struct Members {
    const Place& object;
    std::optional<Place> now;
    /// The member, or null where it is missing and need not be there.
    const Place* find(const char* name, bool needed);
};
template <class Form, class Owner, class... Values>
void read_field(
    const Field<Form, Owner, Values...>& field, Members& members, std::type_identity_t<Owner>& owner, const Folder& folder)
{
    const Place* place = members.find(field.name, field.is_needed);
    if (!place)
        return;
    if constexpr (requires { field.form.read_into(*place, owner, folder); })
        field.form.read_into(*place, owner, folder);
    else if constexpr (sizeof...(Values) == 1 && requires { field.form.read(*place, folder); })
        owner.*described::first(field.members) = field.form.read(*place, folder);
}
template <class Form, class Owner, class... Values> constexpr const char* name_of(const Field<Form, Owner, Values...>& field)
{
    return field.name;
}
template <class Owner, class... Values> constexpr const char* name_of(const NotInFile<Owner, Values...>&) { return nullptr; }
template <class Owner, class... Fields> constexpr auto names_of(const Description<Owner, Fields...>& description)
{
    return description.fields.all([](const auto&... fields) { return std::array{name_of(fields)...}; });
}
template <class T> inline constexpr auto names = names_of(description<T>);

} // namespace described

/// True if a description names as many members as the struct has: a static_assert of it stops a member that was forgotten.
/// As: a struct that derives from T, because another kind of file describes it in another way.
template <class T, class As = T> consteval bool is_complete()
{
    static_assert(std::is_base_of_v<T, As> && sizeof(As) == sizeof(T));
    constexpr std::size_t named = described::all_covered(static_cast<decltype(&description<As>)>(nullptr));
    return described::takes<T>(std::make_index_sequence<named>())
        && !described::takes<T>(std::make_index_sequence<named + 1>());
}

/// How an object differs from its description in one place.
struct Variation {
    const char* tag = nullptr; ///< the member that names the alternative
    const char* without = nullptr; ///< the member that is left out
    bool lacks(const char* name) const;
};

namespace described {

/// True for an object that is a file of its own, which may name its schema.
template <class T> bool names_schema(const Variation& as) { return description<T>.is_file && !as.without; }
/// Throws for a member that is none of the known ones (null: none), and for a "$schema" that is no text.
void reject_others(const Place& place, std::span<const char* const> known, const Variation& as, bool names_schema);

} // namespace described

/// Reads an object's members into a value that has the usual ones.
template <Described T> void read_into(const Place& place, T& value, const Folder& folder, const Variation& as = {})
{
    described::reject_others(place, described::names<T>, as, described::names_schema<T>(as));
    // A base's rules are those of its own kind of file.
    constexpr bool is_own = std::is_same_v<T, typename decltype(description<T>)::Struct>;
    if constexpr (is_own && requires { check_members(place, &value); })
        check_members(place, &value);
    described::Members members{place, {}};
    described::for_each_field<T>([&](const auto& field) {
        if (!as.lacks(field.name))
            described::read_field(field, members, value, folder);
    });
    if constexpr (is_own && requires { check(place, value, folder); })
        check(place, value, folder);
}
template <Described T> T read(const Place& place, const Folder& folder = {}, const Variation& as = {})
{
    T value{};
    read_into(place, value, folder, as);
    return value;
}

namespace described {

void add_number(std::string& text, double number);
/// Adds every number and text of a value to a key: equal values have equal keys, others have others.
template <class T> void add_to_key(std::string& text, const T& value)
{
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        add_number(text, double(value));
    } else if constexpr (Described<T>) {
        text.append(description<T>.name).append(" ");
        for_each_field<T>([&](const auto& field) {
            if constexpr (!std::remove_cvref_t<decltype(field)>::is_again)
                field.members.each([&](const auto member) { add_to_key(text, value.*member); });
        });
    } else if constexpr (requires { value.index(); }) {
        std::visit([&](const auto& one) { add_to_key(text, one); }, value);
    } else if constexpr (requires { value.has_value(); }) {
        add_number(text, value.has_value());
        if (value)
            add_to_key(text, *value);
    } else if constexpr (requires { value.begin(); }) {
        add_number(text, double(value.size()));
        for (const auto& one : value)
            add_to_key(text, one);
    } else {
        for (int i = 0; i < value.length(); ++i)
            add_to_key(text, value[i]);
    }
}

/// A number that the alignment keys change.
struct Turnable {
    std::string pointer; ///< in the file
    double* number;
    Range range;
    double step; ///< of one press
    std::string name; ///< for people
    const char* way = ""; ///< of one of a place's two numbers: "to the right" or "down"
    std::optional<glm::dvec2> unmoved{}; ///< the place that both were before anybody moved it
};
/// Adds those of a value at a pointer, and of the objects in it.
template <class T> void add_turnables(std::vector<Turnable>& all, const std::string& pointer, T& value)
{
    if constexpr (requires { value.index(); })
        std::visit([&](auto& one) { add_turnables(all, pointer, one); }, value);
    else
        for_each_field<T>([&]<class Form, class Owner, class... Values>(const Field<Form, Owner, Values...>& field) {
            const std::string at = pointer + "/" + field.name;
            if constexpr (std::is_same_v<Form, Number>) {
                if (const Number& form = field.form; form.step > 0)
                    all.push_back({at, &(value.*described::first(field.members)), form.range, form.step, form.turned});
            } else if constexpr (requires { field.form.add_turnables(all, at, value); }) {
                field.form.add_turnables(all, at, value);
            } else if constexpr (requires { Form::is_whole; } && sizeof...(Values) == 1) {
                auto& member = value.*described::first(field.members);
                if constexpr (!requires { member.has_value(); })
                    add_turnables(all, at, member);
            }
        });
}

/// A value as the file has it; null where it has none.
template <class Form, class Value> Json written_by(const Form& form, const Value& value)
{
    if constexpr (requires { form.written(value); })
        return form.written(value);
    else if constexpr (requires { form.written(*value); })
        return value ? form.written(*value) : Json();
    else
        return nullptr;
}
template <class Form, class Owner, class... Values>
Json written_field(const Field<Form, Owner, Values...>& field, const std::type_identity_t<Owner>& owner)
{
    if constexpr (sizeof...(Values) > 0)
        return written_by(field.form, owner.*first(field.members));
    else
        return nullptr;
}

/// A field's part of a schema. What follows is no template: schemas of a hundred fields would take half a minute to compile.
struct Property {
    const char* name;
    const char* says;
    bool is_needed;
    Json shape;
    Json usual; ///< null: there is none to tell
};
/// The usual value of a field for its schema.
template <class Form, class Owner, class... Values>
Json usual(const Field<Form, Owner, Values...>& field, const std::type_identity_t<Owner>& owner)
{
    if constexpr (!requires { Form::tells_nothing_usual; })
        return written_field(field, owner);
    return nullptr;
}
void add(std::vector<Property>& all, const char* name, const char* says, bool is_needed, Json&& shape, Json&& usual);
Json schema_of(const char* name, const char* says, const char* rules, bool names_schema, const Variation& as,
    std::vector<Property> properties);
Json whole_schema(const char* name, const Json& object, const Json& definitions);
/// A reference to a definition, which is made if it is not there yet.
Json reference(Json& definitions, const char* name, Json (*made)(Json& definitions));
/// True for values of the same bits: == takes -0 for 0.
bool are_same(const Json& a, const Json& b);
Json list_schema(std::size_t least, std::size_t most, Json item);
Json enum_schema(const std::vector<std::string_view>& names);

} // namespace described

/// A value as its file has it, with every member.
template <Described T> Json written(const T& value)
{
    Json object = Json::object();
    described::for_each_field<T>([&](const auto& field) {
        if (Json one = described::written_field(field, value); !one.is_null())
            object[field.name] = std::move(one);
    });
    return object;
}
/// The same, without the members that may be left out and have their usual values.
template <Described T> Json written_briefly(const T& value)
{
    Json object = Json::object();
    const T usual{};
    described::for_each_field<T>([&](const auto& field) {
        Json one = described::written_field(field, value);
        if (field.is_needed || !described::are_same(one, described::written_field(field, usual)))
            object[field.name] = std::move(one);
    });
    return object;
}

/// A value on one line, as people write it: { "a": 1, "b": [2, 3.5] }. Bytes that are no UTF-8 are replaced.
std::string on_one_line(const Json& value);

/// The schema of an object. definitions: receives those of the structs inside it.
template <Described T> Json object_schema(Json& definitions, const Variation& as = {})
{
    const T usual{};
    std::vector<described::Property> properties;
    described::for_each_field<T>([&](const auto& field) {
        if (!as.lacks(field.name))
            described::add(properties, field.name, field.says, field.is_needed, field.form.schema(definitions),
                described::usual(field, usual));
    });
    return described::schema_of(description<T>.name, description<T>.says, description<T>.rules,
        described::names_schema<T>(as), as, std::move(properties));
}

/// The JSON schema (draft 7) of a kind of file.
template <Described T> Json file_schema()
{
    Json definitions = Json::object();
    const Json object = object_schema<T>(definitions);
    return described::whole_schema(description<T>.name, object, definitions);
}

// The forms.

struct Whole {
    int low, high;
    int read(const Place& place, const Folder&) const { return integer(place, low, high); }
    Json written(int value) const { return value; }
    Json schema(Json&) const;
};
struct Flag {
    bool read(const Place& place, const Folder&) const { return boolean(place); }
    Json written(bool value) const { return value; }
    Json schema(Json&) const;
};
struct Text {
    const char* examples = nullptr; ///< JSON, for the schema
    std::string read(const Place& place, const Folder&) const { return text(place); }
    Json written(const std::string& value) const { return value; }
    Json schema(Json&) const;
};
/// A vector of numbers.
template <int count> struct Numbers {
    using Vector = glm::vec<count, double>;
    Range range;
    Vector read(const Place& place, const Folder&) const
    {
        if constexpr (count == 2)
            return vec2(place, range);
        else if constexpr (count == 3)
            return vec3(place, range);
        else
            return vec4(place, range);
    }
    Json written(const Vector& value) const
    {
        Json list = Json::array();
        for (int i = 0; i < count; ++i)
            list.push_back(value[i]);
        return list;
    }
    Json schema(Json& definitions) const { return described::list_schema(count, count, Number{range}.schema(definitions)); }
};
/// Two whole numbers.
struct WholePair {
    int low, high;
    glm::ivec2 read(const Place& place, const Folder& folder) const;
    Json written(const glm::ivec2& value) const { return {value.x, value.y}; }
    Json schema(Json&) const;
};
/// A name that stands for a value.
template <class Value> struct Named {
    const std::vector<std::pair<std::string_view, Value>>* names;
    Value read(const Place& place, const Folder&) const { return chosen(place, *names); }
    std::string_view name_of(const Value& value) const
    {
        for (const auto& [name, its] : *names)
            if (its == value)
                return name;
        return {};
    }
    Json written(const Value& value) const { return name_of(value); }
    Json schema(Json&) const { return described::enum_schema(names_of(*names)); }
};
template <class Value> Named(const std::vector<std::pair<std::string_view, Value>>*) -> Named<Value>;
/// An object of its own.
template <class T> struct Object {
    static constexpr bool is_whole = true, tells_nothing_usual = true; // nothing varies
    T read(const Place& place, const Folder& folder) const { return starbow::read<T>(place, folder); }
    Json written(const T& value) const { return starbow::written(value); }
    Json schema(Json& definitions) const
    {
        return described::reference(definitions, description<T>.name, [](Json& all) { return object_schema<T>(all); });
    }
};
/// The same, written without the members that have their usual values.
template <class T> struct Brief : Object<T> {
    Json written(const T& value) const { return written_briefly(value); }
};
/// The same, in a place where it varies.
template <class T> struct Varied {
    static constexpr bool tells_nothing_usual = true;
    Variation as;
    T read(const Place& place, const Folder& folder) const { return starbow::read<T>(place, folder, as); }
    Json schema(Json& definitions) const { return object_schema<T>(definitions, as); }
};
/// One of several structs, by the member "type".
template <class Variant> struct Tagged;
template <class... Kinds> struct Tagged<std::variant<Kinds...>> {
    static constexpr bool tells_nothing_usual = true;
    std::variant<Kinds...> read(const Place& place, const Folder& folder) const
    {
        if (!place.json->is_object())
            reject_unknown_members(place, {});
        const std::string type = one_of(member(place, "type"), {description<Kinds>.name...});
        std::variant<Kinds...> value;
        const auto try_one = [&]<class Kind>(const Kind*) {
            if (type == description<Kind>.name)
                value = starbow::read<Kind>(place, folder, {.tag = "type"});
        };
        (try_one(static_cast<const Kinds*>(nullptr)), ...);
        return value;
    }
    Json schema(Json& definitions) const
    {
        Json kinds = Json::array();
        (kinds.push_back(described::reference(
             definitions, description<Kinds>.name, [](Json& all) { return object_schema<Kinds>(all, {.tag = "type"}); })),
            ...);
        return {{"type", "object"}, {"required", {"type"}}, {"oneOf", kinds}};
    }
};
/// A member of a member, and so on, which the file has beside the latter, not in it.
template <class Form, class Owner, class Part, class... Inner> struct Within {
    Form form;
    Part Owner::*part;
    described::Row<Inner...> inner;
    constexpr Within(Form its, Part Owner::*outer, Inner... further)
        : form(its)
        , part(outer)
        , inner{{further}...}
    {
    }
    void read_into(const Place& place, Owner& owner, const Folder& folder) const
    {
        inner.all([&](auto... further) -> auto& { return ((owner.*part).*....*further); }) = form.read(place, folder);
    }
    Json written(const Part& from) const
    {
        return described::written_by(form, inner.all([&](auto... further) -> auto& { return (from.*....*further); }));
    }
    Json schema(Json& definitions) const { return form.schema(definitions); }
};
template <class Form> struct List {
    static constexpr bool tells_nothing_usual = true;
    Form form;
    std::size_t least, most;
    const char* what; ///< its elements, in the plural
    auto read(const Place& place, const Folder& folder) const
    {
        std::vector<decltype(form.read(place, folder))> all;
        for (const Place& one : items(place, least, most, what))
            all.push_back(form.read(one, folder));
        return all;
    }
    template <class Value> Json written(const std::vector<Value>& all) const requires requires(const Value& one)
    {
        form.written(one);
    }
    {
        Json list = Json::array();
        for (const Value& one : all)
            list.push_back(form.written(one));
        return list;
    }
    Json schema(Json& definitions) const { return described::list_schema(least, most, form.schema(definitions)); }
};
template <class Form> List(Form, std::size_t, std::size_t, const char*) -> List<Form>;
/// A value with a reader of its own. shape: JSON, its schema.
template <class Value> struct Own {
    Value (*reader)(const Place&, const Folder&);
    const char* shape;
    Value read(const Place& place, const Folder& folder) const { return reader(place, folder); }
    Json schema(Json&) const { return Json::parse(shape); }
};
template <class Value> Own(Value (*)(const Place&, const Folder&), const char*) -> Own<Value>;

} // namespace starbow

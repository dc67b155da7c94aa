"""Writes glTF 2.0 as one GLB file: meshes, nodes and images into one buffer, in the order they come."""
import json
import struct


class Glb:
    def __init__(self, world="avenue"):
        self.bytes = bytearray()
        self.doc = {"asset": {"version": "2.0", "generator": f"Starbow scenes/{world}/make.py"}, "scene": 0,
                    "scenes": [{"nodes": []}]}

    def add(self, kind, thing):
        things = self.doc.setdefault(kind, [])
        things.append(thing)
        return len(things) - 1

    def view(self, content):
        while len(self.bytes) % 4:
            self.bytes.append(0)
        offset = len(self.bytes)
        self.bytes += content
        return self.add("bufferViews", {"buffer": 0, "byteOffset": offset, "byteLength": len(content)})

    def floats(self, rows, kind, bounds=False):
        width = len(rows[0])
        content = struct.pack(f"<{len(rows) * width}f", *(x for row in rows for x in row))
        accessor = {"bufferView": self.view(content), "componentType": 5126, "count": len(rows), "type": kind}
        if bounds:
            # As stored: a reader compares them with single-precision numbers.
            stored = struct.unpack(f"<{len(rows) * width}f", content)
            accessor["min"] = [min(stored[i::width]) for i in range(width)]
            accessor["max"] = [max(stored[i::width]) for i in range(width)]
        return self.add("accessors", accessor)

    def indices(self, values):
        content = struct.pack(f"<{len(values)}H", *values)
        return self.add("accessors", {"bufferView": self.view(content), "componentType": 5123, "count": len(values),
                                      "type": "SCALAR"})

    def geometry(self, shape, uvs=True):
        """The accessors of a shape, to be shared by meshes of several materials. uvs: for a texture or a clock."""
        attributes = {"POSITION": self.floats(shape.positions, "VEC3", True), "NORMAL": self.floats(shape.normals, "VEC3")}
        if uvs:
            attributes["TEXCOORD_0"] = self.floats(shape.uvs, "VEC2")
        return {"attributes": attributes, "indices": self.indices(shape.indices)}

    def mesh(self, name, geometry, material):
        return self.add("meshes", {"name": name, "primitives": [dict(geometry, material=material)]})

    def group(self, name):
        """A node of whatever is put below it: what a scene file calls a body."""
        group = self.add("nodes", {"name": name, "children": []})
        self.doc["scenes"][0]["nodes"].append(group)
        return group

    def node(self, name, mesh, position=(0, 0, 0), rotation=None, scale=None, below=None):
        node = {"name": name, "mesh": mesh, "translation": list(position)}
        if rotation:
            node["rotation"] = list(rotation)
        if scale:
            node["scale"] = list(scale)
        nodes = self.doc["scenes"][0]["nodes"] if below is None else self.doc["nodes"][below]["children"]
        nodes.append(self.add("nodes", node))

    def put(self, name, shape, material, position=(0, 0, 0), below=None):
        """A shape that stands in one place alone."""
        self.node(name, self.mesh(name, self.geometry(shape), material), position, below=below)

    def texture(self, content, sampler=None):
        kind = "image/png" if content.startswith(b"\x89PNG") else "image/jpeg"
        texture = {"source": self.add("images", {"bufferView": self.view(content), "mimeType": kind})}
        if sampler:
            texture["sampler"] = self.add("samplers", sampler)
        return {"index": self.add("textures", texture)}

    def material(self, name, colour=(1, 1, 1), texture=None, emissive=None, emissive_texture=None, starbow=None):
        """starbow: what colours don't tell, docs/scenes.md."""
        pbr = {"baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": 1}
        if texture:
            pbr["baseColorTexture"] = texture
        material = {"name": name, "pbrMetallicRoughness": pbr}
        if emissive:
            # The factor may not pass 1; what is brighter goes into the strength.
            strength = max(1, *emissive)
            material["emissiveFactor"] = [part / strength for part in emissive]
            if strength > 1:
                material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
                self.doc["extensionsUsed"] = ["KHR_materials_emissive_strength"]
        if emissive_texture:
            material["emissiveTexture"] = emissive_texture
        if starbow:
            material["extras"] = {"starbow": starbow}
        return self.add("materials", material)

    def write(self, path):
        self.doc["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.doc, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        body = bytes(self.bytes) + bytes(-len(self.bytes) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(body)))
            file.write(struct.pack("<II", len(text), 0x4E4F534A) + text)
            file.write(struct.pack("<II", len(body), 0x004E4942) + body)

# SPDX-License-Identifier: BSD-3-Clause
"""The definitions of the server manager for classes in Python: those of the compiled plugin, which lie in the folder xml."""
from __future__ import annotations

import glob
import os
from typing import Any
from xml.etree import ElementTree

from ._missing import PROPERTIES

MODULE = __package__

_NOTE = "\nThis is the portable plugin. The page docs/guide/portable.md says what the compiled one has besides."

_BASES = ("internal_sources", "internal_filters", "internal_writers")
_TAGS = {"GranularLocalReaderProxy": "SourceProxy", "GranularParticleReaderProxy": "SourceProxy", "PWriterProxy": "WriterProxy",
         "GranularMenuProxy": "SourceProxy"}

#: Spheres by ParaView's own Point Gaussian, with the radii of the point array `radius`, as a representation of all points.
_REPRESENTATIONS = """
<ServerManagerConfiguration>
  <ProxyGroup name="representations">
    <RepresentationProxy name="GranularGrainsRepresentation" class="vtkPointGaussianRepresentation" base_proxygroup="representations"
                         base_proxyname="PointGaussianRepresentation" processes="client|renderserver|dataserver">
      <IntVectorProperty name="ScaleByArray" command="SetScaleByArray" number_of_elements="1" default_values="1" override="1">
        <BooleanDomain name="bool"/>
      </IntVectorProperty>
      <StringVectorProperty name="SetScaleArray" command="SelectScaleArray" number_of_elements="5" element_types="0 0 0 0 2"
                            default_values="0;0;0;0;radius" default_values_delimiter=";" panel_visibility="advanced" override="1">
        <!-- radius is in the list, and the default, also where the first frame has no particles -->
        <ArrayListDomain name="array_list" input_domain_name="input_point_array" none_string="radius"
                         pick_first_available_array_by_default="0">
          <RequiredProperties>
            <Property name="Input" function="Input"/>
          </RequiredProperties>
        </ArrayListDomain>
        <Documentation>
          The point array of the radii, in the unit of the points; radius by default. Without one all radii are 1: set the factor.
        </Documentation>
      </StringVectorProperty>
      <IntVectorProperty name="UseScaleFunction" command="SetUseScaleFunction" number_of_elements="1" default_values="0" override="1">
        <BooleanDomain name="bool"/>
      </IntVectorProperty>
      <DoubleVectorProperty name="GaussianRadius" command="SetSplatSize" number_of_elements="1" default_values="1" override="1">
        <Documentation>A factor on the radii; 1 by default.</Documentation>
      </DoubleVectorProperty>
    </RepresentationProxy>
  </ProxyGroup>
  <ProxyGroup name="internal_representations">
    <Extension name="PVRepresentationBase">
      <RepresentationType subproxy="GranularGrainsRepresentation" text="Grains"/>
      <SubProxy>
        <Proxy name="GranularGrainsRepresentation" proxygroup="representations" proxyname="GranularGrainsRepresentation"/>
        <ShareProperties subproxy="SurfaceRepresentation">
          <Exception name="Input"/>
          <Exception name="Visibility"/>
        </ShareProperties>
        <ExposedProperties>
          <PropertyGroup label="Grains">
            <Property name="GaussianRadius" exposed_name="GrainScale"/>
            <!-- another form than GrainRadiusArray, so that state files of either plugin load with the other -->
            <Property name="SetScaleArray" exposed_name="GrainScaleArray"/>
            <Hints>
              <PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Representation" value="Grains"/>
            </Hints>
          </PropertyGroup>
        </ExposedProperties>
      </SubProxy>
    </Extension>
  </ProxyGroup>
</ServerManagerConfiguration>
"""


def _groups() -> list[Any]:
    """The groups of all files, that of the bases first: ParaView ends where a base is not known."""
    folder = os.path.join(os.path.dirname(__file__), "xml")
    paths = glob.glob(os.path.join(glob.escape(folder), "*.xml"))
    if not paths:
        raise ImportError(f"expected the definitions of the plugin in {folder}, got none")
    paths = [path for path in sorted(paths) if os.path.basename(path) != "representations.xml"]
    return [group for path in paths for group in ElementTree.parse(path).getroot()]


class Property:
    """A property of a class by its definition: its default as Python values."""

    def __init__(self, element: Any):
        self.name, self.count = element.get("name"), int(element.get("number_of_elements", "1"))
        self.repeats = element.get("repeat_command") == "1"
        kind = {"IntVectorProperty": int, "IdTypeVectorProperty": int, "DoubleVectorProperty": float}.get(element.tag, str)
        texts = element.get("default_values", "")
        words = texts.split() if kind is not str else [texts]
        self.kind, self.default = kind, [kind(word) for word in words]

    def take(self, given: tuple[Any, ...]) -> Any:
        """Returns what ParaView gave as a value, or a tuple of several; an empty text comes as None, several elements as one list."""
        values = given[0] if len(given) == 1 and isinstance(given[0], (list, tuple)) else given
        made = tuple(self.kind(value) if value is not None else "" for value in values)
        return made if self.count > 1 else made[0]


def _set(algorithm: Any, name: str, value: Any) -> None:
    if algorithm.values.get(name) != value:
        algorithm.values[name] = value
        algorithm.Modified()


def _setter(prop: Property) -> Any:
    return lambda self, *given: _set(self, prop.name, prop.take(given))


def _add_setters(made: type, elements: list[Any]) -> None:
    """Gives a class the setters of its properties and their defaults."""
    made.defaults = dict(getattr(made, "defaults", {}))
    for element in elements:
        command, clean = element.get("command", ""), element.get("clean_command")
        if clean and not hasattr(made, command):
            prop = Property(element)
            made.defaults[prop.name] = ()
            setattr(made, clean, lambda self, name=prop.name: _set(self, name, ()))
            setattr(made, command, lambda self, value, prop=prop: _set(self, prop.name, (*self.values[prop.name], prop.kind(value))))
        if not command.startswith("Set") or element.get("information_only") == "1" or element.tag == "InputProperty":
            continue
        prop = Property(element)
        if prop.name == "Preset":  # the library knows it by its name
            made.presets = {int(entry.get("value")): entry.get("text") for entry in element.iter("Entry")}
        made.defaults[prop.name] = prop.take(tuple(prop.default)) if prop.default else ""
        if not hasattr(made, command):
            setattr(made, command, _setter(prop))


def define(classes: dict[str, type]) -> Any:
    """Returns an object that ParaView asks for the definitions of these classes, which get the setters of their properties."""
    root = ElementTree.fromstring(_REPRESENTATIONS)
    proxies: dict[str, Any] = {}
    kept, defined = [], []
    for group in _groups():
        for proxy in list(group):
            proxies[proxy.get("name")] = proxy
            own = classes.get(proxy.get("class", ""))
            if group.get("name") not in _BASES and own is None:
                group.remove(proxy)
                continue
            for element in [element for element in proxy if element.get("name") in PROPERTIES]:
                proxy.remove(element)
            if proxy.tag == "PWriterProxy":
                proxy.set("supports_parallel", "1")
            proxy.tag = _TAGS.get(proxy.tag, proxy.tag)
            if own is not None:
                proxy.set("class", f"{MODULE}.{own.__name__}")
                proxy.set("si_class", "vtkSIPythonSourceProxy")
                text = proxy.find("Documentation")
                if text is not None:
                    text.text += _NOTE
                defined.append((own, proxy))
        if len(group):
            kept.append(group)
    for own, base in defined:
        while base is not None:
            _add_setters(own, list(base))
            base = proxies.get(base.get("base_proxyname", ""))
    root[0:0] = kept

    class Definitions:
        _pvsm_proxy_xml = ElementTree.tostring(root, encoding="unicode")

    return Definitions

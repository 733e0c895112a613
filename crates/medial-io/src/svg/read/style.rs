//! What attributes and style sheets say of an element.

use roxmltree::Node;
use simplecss::{AttributeOperator, Element, PseudoClass, StyleSheet};
use std::collections::BTreeMap;
use std::rc::Rc;

/// Properties that children take over.
const INHERITED: &[&str] = &[
    "color",
    "direction",
    "fill",
    "fill-opacity",
    "fill-rule",
    "font-family",
    "font-size",
    "font-stretch",
    "font-style",
    "font-variant",
    "font-weight",
    "font-kerning",
    "font-variation-settings",
    "font",
    "kerning",
    "letter-spacing",
    "marker",
    "marker-end",
    "marker-mid",
    "marker-start",
    "stroke",
    "stroke-dasharray",
    "stroke-dashoffset",
    "stroke-linecap",
    "stroke-linejoin",
    "stroke-miterlimit",
    "stroke-opacity",
    "stroke-width",
    "text-anchor",
    "text-rendering",
    "visibility",
    "word-spacing",
    "writing-mode",
];

/// Properties of an element alone; sizes and places may be said by style sheets too (SVG 2, 7.2).
const OWN: &[&str] = &[
    "clip-path",
    "cx",
    "cy",
    "display",
    "filter",
    "height",
    "mask",
    "opacity",
    "r",
    "rx",
    "ry",
    "transform",
    "transform-box",
    "transform-origin",
    "vector-effect",
    "width",
    "x",
    "y",
];

/// The properties that hold for an element.
#[derive(Clone, Debug, Default)]
pub(super) struct Style {
    inherited: Rc<BTreeMap<&'static str, String>>,
    own: BTreeMap<&'static str, String>,
}

impl Style {
    /// The style of a child.
    pub fn child(&self, node: Node, sheet: &StyleSheet) -> Self {
        let mut style = Self { inherited: Rc::clone(&self.inherited), own: BTreeMap::new() };
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            style.set(attribute.name(), attribute.value(), self);
        }
        let mut important = Vec::new();
        for rule in &sheet.rules {
            if rule.selector.matches(&Xml(node)) {
                for declaration in &rule.declarations {
                    style.set(declaration.name, declaration.value, self);
                    if declaration.important {
                        important.push((declaration.name, declaration.value));
                    }
                }
            }
        }
        let inline = node.attribute("style").unwrap_or_default();
        for declaration in simplecss::DeclarationTokenizer::from(inline) {
            style.set(declaration.name, declaration.value, self);
        }
        for (name, value) in important {
            style.set(name, value, self);
        }
        style
    }

    fn set(&mut self, name: &str, value: &str, parent: &Self) {
        let value = value.trim();
        if let Some(name) = INHERITED.iter().find(|known| **known == name) {
            let value = match value {
                "inherit" | "unset" => parent.get(name),
                _ => Some(value),
            };
            let all = Rc::make_mut(&mut self.inherited);
            match value {
                Some(value) => all.insert(name, value.to_owned()),
                None => all.remove(name),
            };
        } else if let Some(name) = OWN.iter().find(|known| **known == name) {
            self.own.insert(name, value.to_owned());
        }
    }

    pub fn get(&self, name: &str) -> Option<&str> {
        self.own.get(name).or_else(|| self.inherited.get(name)).map(String::as_str)
    }

    /// The inherited properties.
    pub fn inherited(&self) -> impl Iterator<Item = (&'static str, &str)> {
        self.inherited.iter().map(|(name, value)| (*name, value.as_str()))
    }

    /// Whether it and all in it is not drawn.
    pub fn is_hidden(&self) -> bool {
        self.get("display") == Some("none") || self.opacity("opacity") == 0.0
    }

    pub fn is_invisible(&self) -> bool {
        matches!(self.get("visibility"), Some("hidden" | "collapse"))
    }

    /// The paint by this property, if it paints; a `default` where nothing is said.
    pub fn paint(&self, name: &str, default: Option<&str>) -> Option<String> {
        let paint = self.get(name).or(default)?;
        if matches!(paint, "none" | "transparent")
            || self.opacity(&format!("{name}-opacity")) == 0.0
        {
            return None;
        }
        let paint = match paint {
            "currentColor" | "currentcolor" => self.get("color").unwrap_or("black"),
            paint => paint,
        };
        Some(paint.to_owned())
    }

    fn opacity(&self, name: &str) -> f64 {
        let Some(value) = self.get(name) else { return 1.0 };
        let (number, share) = match value.strip_suffix('%') {
            Some(number) => (number, 0.01),
            None => (value, 1.0),
        };
        number.trim().parse::<f64>().map_or(1.0, |v| v * share)
    }
}

/// An element as style sheets see it.
struct Xml<'a, 'input>(Node<'a, 'input>);

impl Element for Xml<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Self)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Self)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, local_name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0.attribute(local_name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.0.prev_sibling_element().is_none()
    }
}

//! What the tables of an axis have in common when they are looked at.

/// Gives a view of a numbered table, which has `len` and `at`, its iterators.
macro_rules! view {
    ($View:ident of $Item:ident; $(#[$about:meta])* $Iter:ident) => {
        impl<'a> $View<'a> {
            /// Whether there are none.
            #[must_use]
            pub fn is_empty(self) -> bool {
                self.len() == 0
            }

            /// All of them, in their order.
            #[must_use]
            pub fn iter(self) -> $Iter<'a> {
                // No table has more than can be numbered.
                $Iter { all: self, rest: 0..self.len() as u32 }
            }
        }

        impl PartialEq for $View<'_> {
            fn eq(&self, other: &Self) -> bool {
                self.iter().eq(other.iter())
            }
        }

        impl ::std::fmt::Debug for $View<'_> {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.debug_list().entries(self.iter()).finish()
            }
        }

        impl<'a> IntoIterator for $View<'a> {
            type Item = $Item;
            type IntoIter = $Iter<'a>;

            fn into_iter(self) -> $Iter<'a> {
                self.iter()
            }
        }

        $(#[$about])*
        #[derive(Clone, Debug)]
        pub struct $Iter<'a> {
            all: $View<'a>,
            rest: ::std::ops::Range<u32>,
        }

        impl Iterator for $Iter<'_> {
            type Item = $Item;

            fn next(&mut self) -> Option<$Item> {
                self.rest.next().map(|k| self.all.at(k))
            }

            fn size_hint(&self) -> (usize, Option<usize>) {
                self.rest.size_hint()
            }

            fn nth(&mut self, n: usize) -> Option<$Item> {
                self.rest.nth(n).map(|k| self.all.at(k))
            }
        }

        impl DoubleEndedIterator for $Iter<'_> {
            fn next_back(&mut self) -> Option<$Item> {
                self.rest.next_back().map(|k| self.all.at(k))
            }
        }

        impl ExactSizeIterator for $Iter<'_> {
            fn len(&self) -> usize {
                self.rest.len()
            }
        }

        impl ::std::iter::FusedIterator for $Iter<'_> {}
    };
}

pub(super) use view;

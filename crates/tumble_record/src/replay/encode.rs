//! Numbers as base64 (RFC 4648, section 4) of little-endian 32-bit words.

/// Encodes numbers rounded to 32-bit floats.
pub fn floats(numbers: impl Iterator<Item = f64>) -> String {
    base64(numbers.flat_map(|number| (number as f32).to_le_bytes()))
}

/// Encodes counts and indices, all of them below 2³².
pub fn words(numbers: impl Iterator<Item = usize>) -> String {
    base64(numbers.flat_map(|number| u32::try_from(number).unwrap_or(u32::MAX).to_le_bytes()))
}

pub fn base64(mut bytes: impl Iterator<Item = u8>) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    while let Some(first) = bytes.next() {
        let (second, third) = (bytes.next(), bytes.next());
        let group = u32::from_be_bytes([0, first, second.unwrap_or(0), third.unwrap_or(0)]);
        let digit = |shift: u32| char::from(DIGITS[(group >> shift) as usize & 63]);
        text.push(digit(18));
        text.push(digit(12));
        text.push(second.map_or('=', |_| digit(6)));
        text.push(third.map_or('=', |_| digit(0)));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_matches_the_examples_of_the_standard() {
        // RFC 4648, section 10.
        let examples =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")];
        for (text, encoded) in examples {
            assert_eq!(base64(text.bytes()), encoded);
        }
    }

    #[test]
    fn words_are_little_endian() {
        assert_eq!(words([1, usize::MAX].into_iter()), base64([1, 0, 0, 0, 255, 255, 255, 255].into_iter()));
        assert_eq!(floats([1.0].into_iter()), base64([0, 0, 0x80, 0x3f].into_iter()));
    }
}

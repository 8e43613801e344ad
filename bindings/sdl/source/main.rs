fn main() {
    println!("{}", sdl3_src::SOURCE_DIR);
}

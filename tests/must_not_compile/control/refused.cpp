// expect: error: .*the law is missing its stiffness
template <class Law>
void use(const Law& law) {
  static_assert(
      requires { law.stiffness; }, "the law is missing its stiffness");
}

struct Empty {};

int main() {
  use(Empty{});
}
